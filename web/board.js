// What the hand's movements on the picture mean: the view, or a sphere where the person says so.
import { dollied, orbited } from "./camera.js";
import { watchGestures } from "./gestures.js";
import { createSphereMover } from "./move_sphere.js";

/// `board` holds the picture and #outline; `moveTool` is checked while dragging moves spheres, which
/// Shift does as well; `hint` says what it does. `camera()` is null while there is none, `text()` the document. `onGrab()`,
/// then `onDrag(text)` follow a sphere that is moved, `onLook(camera)` a view.
export function createBoard(board, moveTool, hint, { camera, text, onGrab, onDrag, onLook }) {
  const mover = createSphereMover(board.querySelector("#outline"));
  let isFresh = false;  // grabbed, and not dragged yet: a mere click edits nothing
  const means = (event) => camera() !== null && (moveTool.checked || event.shiftKey);
  const look = (change) => {
    if (camera() === null) return;
    mover.hide();
    onLook(change(camera()));
  };

  const say = () => {
    hint.textContent = moveTool.checked
      ? "Drag moves a sphere, and orbits where there is none; the wheel goes nearer. Keys: arrows, + and −."
      : "Drag orbits, the wheel goes nearer; Shift and drag moves a sphere. Keys: arrows, + and −.";
  };
  moveTool.closest("fieldset").addEventListener("change", say);
  say();

  watchGestures(board, {
    grab(x, y, event) {
      if (!means(event) || !mover.grab(camera(), text(), x, y)) return false;
      isFresh = true;
      return true;
    },
    drag(dx, dy, x, y) {
      if (isFresh) onGrab();
      isFresh = false;
      onDrag(mover.drag(camera(), x, y));
    },
    drop: () => mover.drop(),
    orbit: (sideways, over) => look((now) => orbited(now, sideways, over)),
    dolly: (factor) => look((now) => dollied(now, factor)),
    hover(x, y, event) {
      const isMove = means(event);
      board.classList.toggle("over-sphere", isMove && mover.point(camera(), text(), x, y));
      if (!isMove) mover.hide();
    },
    leave: () => mover.hide(),
  });
}
