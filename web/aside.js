// Edits that another scene has replaced, until they are brought back: the latest first, and by
// another press the ones before.
import { passFocus } from "./focus.js";

const most_kept = 5;

/// `button` is in sight while there are any; `neighbour` gets its focus after the last. `current()`
/// gives the edits of this moment, {loaded, text}, or null; they take the place of those that are
/// brought back, which go to `onBring(edit)`.
export function createAside(button, neighbour, { current, onBring }) {
  let kept = [];  // the latest last

  const show = () => {
    button.hidden = kept.length === 0;
  };

  button.addEventListener("click", () => {
    const edit = kept.pop();
    const replaced = current();
    if (replaced) kept.unshift(replaced);  // so that each has its turn
    if (kept.length === 0) passFocus(button, neighbour);
    show();
    onBring(edit);
  });

  return {
    get edits() {
      return kept;
    },
    add(...edits) {
      const texts = new Set(edits.map(({ text }) => text));
      kept = [...kept.filter(({ text }) => !texts.has(text)), ...edits].slice(-most_kept);
      show();
    },
  };
}
