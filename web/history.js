// Former texts, for edits that the form and the hand make: the textarea's own undo knows only keys.

const most_kept = 100;
const together_ms = 800;  // edits of one value that follow each other sooner are one

export function createHistory(button, restore) {
  const former = [];
  let last = { what: null, at_ms: 0 };

  const show = () => {
    button.disabled = former.length === 0;
  };

  function undo() {
    if (former.length === 0) return;
    last = { what: null, at_ms: 0 };
    const text = former.pop();
    show();
    restore(text);
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
      if (isSame) return;
      former.push(text);
      if (former.length > most_kept) former.shift();
      show();
    },
    forget() {
      former.length = 0;
      show();
    },
  };
}
