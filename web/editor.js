// The scene's text: a textarea, with line numbers beside it and its colours painted behind it.
//
// The textarea keeps everything that a person expects of one (selection, undo, search, input
// methods); its own glyphs are transparent. Only the lines in sight are painted, so that a long
// document costs no more than a short one. Lines do not wrap: a line's place is its number times
// the line height. Of a long text the textarea holds the part that the scrolling is at.
import { lineAndColumn } from "./json_pointer.js";
import { concernsCaret, editorKeys } from "./editor_keys.js";
import { moveMarks } from "./editor_marks.js";
import { stepOf } from "./history.js";
import { messagesByLine, numberRow, textRow } from "./editor_rows.js";
import { createHeldText } from "./held_text.js";

const spare_lines = 8;  // painted above and below what is in sight

/// `box` holds #editor, #gutter and #paint. `onInput(former, line)` follows a change by the person, of the text
/// `former` and in that line; before one that replaces what is selected goes `onReplace()`; `onUndo(isRedo)`
/// is to undo, of all changes the last; `onMarksMoved()` follows a change of the lines of the marks.
export function createEditor(box, { onInput, onReplace, onUndo, onMarksMoved }) {
  const area = box.querySelector("textarea");
  const held = createHeldText(area);
  const painter = createPainter(box, area, held);
  let marks = [];  // {start, end, line, message}
  let caretLine = 1;

  function repaint() {
    painter(marks, caretLine);
    document.querySelector("#with-lines").hidden = !held.hasLongLine();
  }

  // Not by the textarea, which knows of its own keys alone.
  function undo(isRedo) {
    const former = held.text;
    onUndo(isRedo);
    held.showChange(former);
  }

  function changed(former) {
    if (marks.length > 0) {
      moveMarks(marks, former, held.text);
      onMarksMoved();
    }
    repaint();
    onInput(former, caretLine);
  }

  area.addEventListener("input", () => {
    const former = held.text;
    held.readTyped();
    changed(former);
  });
  area.addEventListener("keydown", (event) => {
    const { key, ctrlKey, shiftKey } = event;
    const end = ctrlKey && !shiftKey && { Home: 0, End: held.text.length }[key];
    const step = stepOf(event);
    if (step !== null) {
      event.preventDefault();
      undo(step === "redo");
    } else if (held.isPart() && Number.isFinite(end)) {
      event.preventDefault();
      held.goTo({ start: end });
    } else if (concernsCaret(event)) {
      held.comeBack();
    }
  });
  area.addEventListener("beforeinput", (event) => {
    if (event.inputType.startsWith("history")) {  // by a menu
      event.preventDefault();
      undo(event.inputType === "historyRedo");
      return;
    }
    held.comeBack();
    if (!held.isAllSelected()) return;
    onReplace();
    held.letGoOfRest();
  });
  area.addEventListener("scroll", () => {
    held.slide();
    repaint();
  });
  area.addEventListener("mousemove", ({ offsetY }) => {
    const line = held.lineAt(offsetY);
    area.title = marks.filter((mark) => mark.line === line).map((mark) => mark.message).join("\n");
  });
  document.addEventListener("selectionchange", () => {
    const caret = document.activeElement === area ? held.caret() : null;
    if (!caret) return;
    document.querySelector("#caret").textContent = `${caret.line}:${caret.column}`;
    if (caret.line === caretLine) return;
    caretLine = caret.line;
    repaint();
  });
  new ResizeObserver(repaint).observe(area);
  editorKeys(area);
  useClipboard(area, held, (inserted) => {
    const former = held.text;
    onReplace();
    held.replaceSelection(inserted);
    changed(former);
  });

  return {
    get text() {
      return held.text;
    },

    /// Replaces the whole text; marks and undo history end with it.
    set text(next) {
      marks = [];
      caretLine = 1;
      held.begin(next.replace(/\r\n?/g, "\n"));  // as a textarea has it
      repaint();
    },

    /// Another state of the same document: what is in sight stays so.
    revise(next) {
      const former = held.text;
      held.revise(next);
      moveMarks(marks, former, next);
      repaint();
    },

    /// Marks what is wrong in `about`, the text or a former state of it: [{start, end, line,
    /// message}]. The numbers are kept up to date with the text in the objects that were given.
    mark(next, about) {
      marks = next;
      if (about !== held.text) moveMarks(marks, about, held.text);
      if (marks.length > 0 && !marks.some(held.isInSight)) held.scrollTo(marks[0]);
      area.setAttribute("aria-invalid", String(marks.length > 0));
      area.title = "";
      repaint();
    },

    /// Selects from `start` to `end`, in sight and focused.
    reveal({ start, end }) {
      const { line, column } = lineAndColumn(held.text, start);
      area.focus();
      held.scrollTo({ start, line });
      held.select({ start, end });
      const columnWidth = area.scrollWidth / Math.max(80, ...held.part.lines.map((each) => each.length));
      area.scrollLeft = column * columnWidth < area.clientWidth * 0.8 ? 0 : (column - 20) * columnWidth;
    },
  };
}

// A function that paints the lines in sight, with what is wrong in them.
function createPainter(box, area, held) {
  const gutter = box.querySelector("#gutter");
  const paint = box.querySelector("#paint");

  return (marks, caretLine) => {
    const { lines, firstLine, lineCount } = held.part;
    const height = held.lineHeight();
    const first = Math.max(0, Math.floor(area.scrollTop / height) - spare_lines);
    const count = Math.ceil(area.clientHeight / height) + 2 * spare_lines;
    const messages = messagesByLine(marks);
    const numbers = [];
    const rows = [];
    for (let index = first; index < Math.min(lines.length, first + count); index += 1) {
      const line = firstLine + index;
      const wrong = messages.get(line);
      numbers.push(numberRow(line, line === caretLine, wrong));
      rows.push(textRow(lines[index], wrong));
    }
    box.style.setProperty("--digits", String(lineCount).length);
    gutter.replaceChildren(...numbers);
    paint.replaceChildren(...rows);
    // Reading scrollWidth lays the page out: once, after all writing but the last.
    paint.style.width = `${area.scrollWidth}px`;
    const top = first * height - area.scrollTop;
    gutter.style.transform = `translateY(${top}px)`;
    paint.style.transform = `translate(${-area.scrollLeft}px, ${top}px)`;
  };
}

// What is copied and pasted may be more than the textarea holds: `replace(inserted)` replaces the selection then.
function useClipboard(area, held, replace) {
  area.addEventListener("paste", (event) => {
    held.comeBack();
    const pasted = event.clipboardData.getData("text/plain").replaceAll("\r\n", "\n");
    if (held.hasRoomFor(pasted)) return;
    event.preventDefault();
    replace(pasted);
  });
  for (const taking of ["copy", "cut"]) area.addEventListener(taking, (event) => {
    held.comeBack();
    if (!held.isAllSelected()) return;
    event.preventDefault();
    event.clipboardData.setData("text/plain", held.text);
    if (taking === "cut") replace("");
  });
}
