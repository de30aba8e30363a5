// What a hand does on the picture, as movements: dragging, the wheel, two fingers, keys.
// What they mean is the caller's: see main.js.

const key_step = 0.08;   // radians for a press of an arrow key
const key_dolly = 1.12;  // times nearer or farther for a press of + or -
const keys = {
  ArrowLeft: [-key_step, 0], ArrowRight: [key_step, 0], ArrowUp: [0, key_step], ArrowDown: [0, -key_step],
};

/// `board` is focusable and holds the picture. `to`: {grab(x, y, event), drag(dx, dy, x, y), drop(),
/// orbit(sideways, over), dolly(factor), hover(x, y, event), leave()}. x, y, dx, dy: parts of the
/// board's width and height. grab returns whether drag follows; else dragging orbits.
export function watchGestures(board, to) {
  const touching = new Map();  // pointer to where it was
  let isHeld = false;          // by grab

  const placeOf = (event) => {
    const box = board.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  };
  const apart = () => {
    const [a, b] = [...touching.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };

  board.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target.closest("input, button")) return;
    const place = placeOf(event);
    if (event.isTrusted) board.setPointerCapture(event.pointerId);
    touching.set(event.pointerId, place);
    if (touching.size === 1) isHeld = to.grab(...place, event);
  });
  board.addEventListener("pointermove", (event) => {
    const place = placeOf(event);
    const former = touching.get(event.pointerId);
    if (!former) {
      to.hover(...place, event);
      return;
    }
    const formerApart = touching.size === 2 ? apart() : 0;
    touching.set(event.pointerId, place);
    const [dx, dy] = [place[0] - former[0], place[1] - former[1]];
    if (touching.size === 2) to.dolly(formerApart / Math.max(apart(), 1e-6));
    else if (isHeld) to.drag(dx, dy, ...place);
    else to.orbit(dx * Math.PI, dy * Math.PI);
  });
  const release = (event) => {
    if (!touching.delete(event.pointerId) || touching.size > 0) return;
    if (isHeld) to.drop();
    isHeld = false;
  };
  for (const end of ["pointerup", "pointercancel"]) board.addEventListener(end, release);
  board.addEventListener("pointerleave", () => to.leave());

  board.addEventListener("wheel", (event) => {
    if (event.ctrlKey && event.deltaY === 0) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    to.dolly(Math.exp(Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0012));
  }, { passive: false });

  board.addEventListener("keydown", (event) => {
    if (event.target !== board || event.ctrlKey || event.metaKey || event.altKey) return;
    if (keys[event.key]) to.orbit(...keys[event.key]);
    else if (event.key === "+" || event.key === "=") to.dolly(1 / key_dolly);
    else if (event.key === "-") to.dolly(key_dolly);
    else return;
    event.preventDefault();
  });
}
