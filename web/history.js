// Former texts, of all edits: the textarea's own undo knows only keys, and forgets them when the form
// or the hand edits too.

const most_kept = 100;
const most_characters = 50_000_000;  // of all that are kept, but for the last
const together_ms = 800;  // edits of one value that follow each other sooner are one

/// `button` undoes an edit: `restore(text)` follows with the text before it. `current()` is the text.
export function createHistory(button, { current, restore }) {
  const former = [];
  let last = { what: null, at_ms: 0 };

  const show = () => {
    button.disabled = former.length === 0;
  };

  function undo() {
    last = { what: null, at_ms: 0 };
    const now = current();
    let text = now;
    while (text === now && former.length > 0) text = former.pop();  // what was undone by other means, or came to nothing
    show();
    if (text !== now) restore(text);
  }

  button.addEventListener("click", undo);
  document.addEventListener("keydown", (event) => {
    if (event.key !== "z" || !(event.ctrlKey || event.metaKey) || event.target.matches("textarea, input[type=number]")) return;
    event.preventDefault();
    undo();
  });

  return {
    /// `text` as it is before an edit of `what`.
    keep(text, what) {
      const now_ms = performance.now();
      const isSame = what === last.what && now_ms - last.at_ms < together_ms;
      last = { what, at_ms: now_ms };
      if (isSame || text === former.at(-1)) return;
      former.push(text);
      let characters = former.reduce((sum, each) => sum + each.length, 0);
      while (former.length > most_kept || (former.length > 1 && characters > most_characters)) characters -= former.shift().length;
      show();
    },
    undo,
    forget() {
      former.length = 0;
      show();
    },
  };
}
