// A view: the camera as the hand left it, where that is not the document's own.
import { length, subtract } from "./camera.js";
import { rounded, withValue } from "./json_edit.js";

/// `text` with the view's camera in it; `view` null: as it is.
export function withView(text, view) {
  if (!view) return text;
  return ["origin", "look_at", "up"].reduce((next, key) => withValue(next, `/camera/${key}`, view[key]), text);
}

/// `view` with the digits that show: its origin within a ten-millionth of how far the hand has taken
/// it from the document's camera `own`, or of how far it looks.
export function shortView(view, own) {
  const moved = length(subtract(view.origin, own.origin));
  const step = Math.min(moved, length(subtract(view.look_at, view.origin))) / 1e7;
  return { ...view, origin: view.origin.map((value) => rounded(value, step)) };
}

/// For a link: "x,y,z;x,y,z;x,y,z", and back; null if it is none.
export function viewText(view) {
  return [view.origin, view.look_at, view.up].map((point) => point.join(",")).join(";");
}

export function readView(text) {
  const points = (text ?? "").split(";").map((point) => point.split(",").map(Number));
  const isView = points.length === 3 && points.every((point) => point.length === 3 && point.every(Number.isFinite));
  return isView ? { origin: points[0], look_at: points[1], up: points[2] } : null;
}

/// Whether two cameras are the same.
export function sameCamera(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
