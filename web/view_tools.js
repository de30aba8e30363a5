// What the hand made of the camera, and the two ways on from there: back, or into the document.
import { passFocus } from "./focus.js";

/// `box` holds #reset-view and #keep-view, and is in sight while there is a view; `neighbour` gets
/// their focus then. `onReset()` follows when there is none any more, `onKeep(view)` is to write it.
export function createViewTools(box, neighbour, { onReset, onKeep }) {
  const [reset, keep] = ["reset-view", "keep-view"].map((id) => box.querySelector(`#${id}`));
  let view = null;

  function take(next) {
    view = next;
    if (!view) passFocus(box, neighbour);
    box.hidden = view === null;
  }

  reset.addEventListener("click", () => {
    take(null);
    onReset();
  });
  keep.addEventListener("click", () => onKeep(view));

  return {
    /// {origin, look_at, up} as the hand left them; null: the document's own.
    get view() {
      return view;
    },
    set view(next) {
      take(next);
    },
  };
}
