// Keys that make a textarea an editor of JSON: Tab indents, Enter keeps the indentation.
// Escape gives the next Tab back to the page, so that the keyboard never gets stuck here.

/// Whether a key types, deletes or moves the caret.
export function concernsCaret({ key, ctrlKey, metaKey }) {
  const isCommand = ctrlKey || metaKey;
  if (key.length === 1 || key === "Enter" || key === "Tab") return !isCommand;
  return /^(Arrow|Page|Home|End|Backspace|Delete|Process|Unidentified)/.test(key);
}

export function editorKeys(area) {
  let tabLeaves = false;

  area.addEventListener("keydown", (event) => {
    const plain = !event.ctrlKey && !event.metaKey && !event.altKey && !event.isComposing;
    if (event.key === "Tab" && !event.shiftKey && plain && !tabLeaves) {
      event.preventDefault();
      indent(area);
    } else if (event.key === "Enter" && plain) {
      event.preventDefault();
      insert(area, `\n${indentationAt(area.value, area.selectionStart)}`);
    }
    if (event.key !== "Shift") tabLeaves = event.key === "Escape";
  });
  area.addEventListener("blur", () => {
    tabLeaves = false;
  });
}

// One level deeper: the lines of the selection if it has several, else two spaces at the caret.
function indent(area) {
  const { value, selectionStart, selectionEnd } = area;
  if (!value.slice(selectionStart, selectionEnd).includes("\n")) {
    insert(area, "  ");
    return;
  }
  const start = value.lastIndexOf("\n", selectionStart - 1) + 1;
  area.setSelectionRange(start, selectionEnd);
  const indented = value.slice(start, selectionEnd).replace(/^(?=.)/gm, "  ");
  insert(area, indented);
  area.setSelectionRange(start, start + indented.length);
}

function indentationAt(text, offset) {
  const lineStart = text.lastIndexOf("\n", offset - 1) + 1;
  const indentation = /^ */.exec(text.slice(lineStart, offset))[0];
  return /[{[]\s*$/.test(text.slice(lineStart, offset)) ? `${indentation}  ` : indentation;
}

// execCommand is deprecated, but nothing else writes into a textarea's undo history.
function insert(area, text) {
  if (document.execCommand("insertText", false, text)) return;
  area.setRangeText(text, area.selectionStart, area.selectionEnd, "end");
  area.dispatchEvent(new Event("input"));
}
