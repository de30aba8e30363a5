// Former texts, of all edits: a textarea's own undo knows only keys, and forgets them when the form or the
// hand edits too.
import { passFocus } from "./focus.js";

const most_kept = 100;
const most_characters = 50_000_000;  // of all that are kept, but for the last
const together_ms = 800;  // edits of one value that follow each other sooner are one

export const isMac = /Mac|iPhone|iPad/.test(navigator.platform);

/// "undo", "redo" or null: what a key asks for.
export function stepOf({ key, ctrlKey, metaKey, shiftKey, altKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  if (key.toLowerCase() === "z") return shiftKey ? "redo" : "undo";
  return key.toLowerCase() === "y" && !isMac ? "redo" : null;
}

/// `undoer` and `redoer` are buttons: `restore(text)` follows with the text before an edit, or after one
/// that was undone. `current()` is the text.
export function createHistory({ undoer, redoer }, { current, restore }) {
  const former = [];
  const undone = [];
  let last = { what: null, at_ms: 0 };

  function show() {
    const states = [[undoer, former], [redoer, undone]];
    for (const [button, texts] of states) if (texts.length > 0) button.disabled = false;
    if (former.length === 0) passFocus(undoer, redoer);
    if (undone.length === 0) passFocus(redoer, undoer);
    for (const [button, texts] of states) button.disabled = texts.length === 0;
  }

  // To the last of `from`; what is left goes to the end of `to`.
  function step(from, to) {
    last = { what: null, at_ms: 0 };
    const now = current();
    let text = now;
    while (text === now && from.length > 0) text = from.pop();  // what was changed by other means, or came to nothing
    if (text !== now) to.push(now);
    show();
    if (text !== now) restore(text);
  }

  const undo = () => step(former, undone);
  const redo = () => step(undone, former);
  undoer.addEventListener("click", undo);
  redoer.addEventListener("click", redo);
  document.addEventListener("keydown", (event) => {
    const step = stepOf(event);
    if (step === null || event.target.closest("textarea, input[type=number], dialog")) return;
    event.preventDefault();
    if (step === "redo") redo();
    else undo();
  });

  return {
    /// `text` as it is before an edit of `what`.
    keep(text, what) {
      const now_ms = performance.now();
      const isSame = what === last.what && now_ms - last.at_ms < together_ms;
      last = { what, at_ms: now_ms };
      undone.length = 0;
      if (!isSame && text !== former.at(-1)) former.push(text);
      let characters = former.reduce((sum, each) => sum + each.length, 0);
      while (former.length > most_kept || (former.length > 1 && characters > most_characters)) characters -= former.shift().length;
      show();
    },
    undo,
    redo,
    forget() {
      former.length = undone.length = 0;
      show();
    },
  };
}
