// A camera as the scene document has it, {origin, look_at, up, fov}, and how a hand moves it. The
// rays are those of the document's definition; see "Camera" there. Nothing here changes what it is given.

export const add = (a, b) => a.map((value, axis) => value + b[axis]);
export const subtract = (a, b) => a.map((value, axis) => value - b[axis]);
export const scale = (a, factor) => a.map((value) => value * factor);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a) => Math.hypot(...a);
export const unit = (a) => scale(a, 1 / length(a));
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

const nearest_to_up = 0.03;  // radians: closer, and left and right would change places in a step

/// The camera of a document, with `up` filled in; null if it has none that can be read.
export function cameraIn(document) {
  const { origin, look_at, up = [0, 1, 0], fov, width, height } = document.camera ?? {};
  const isPoint = (value) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
  if (![origin, look_at, up].every(isPoint) || ![fov, width, height].every(Number.isFinite)) return null;
  return { origin, look_at, up, fov, width, height };
}

/// The directions of the picture: into it, to its right, upwards; and half its extents at distance 1.
export function axesOf({ origin, look_at, up, fov, width, height }) {
  const into = unit(subtract(look_at, origin));
  let right = cross(unit(up), into);
  if (length(right) < 1e-12) right = cross(leastAligned(into), into);
  right = unit(right);
  const turn = 2 * Math.PI;
  const halfWidth = Math.tan((((fov % turn) + turn) % turn) / 2);
  return { into, right, upwards: cross(into, right), halfWidth, halfHeight: (halfWidth * height) / width };
}

function leastAligned(direction) {
  let best = 0;
  for (const axis of [2, 1]) if (Math.abs(direction[axis]) < Math.abs(direction[best])) best = axis;
  return [0, 1, 2].map((axis) => (axis === best ? 1 : 0));
}

/// The direction of the ray through (x, y): parts of the picture's width and height, from its upper left.
export function rayThrough(camera, x, y) {
  const { into, right, upwards, halfWidth, halfHeight } = axesOf(camera);
  const sideways = scale(right, (2 * x - 1) * halfWidth);
  return unit(add(into, add(sideways, scale(upwards, (1 - 2 * y) * halfHeight))));
}

/// Where a point is seen, as rayThrough's (x, y); null if it is not in front of the eye.
export function seenAt(camera, point) {
  const { into, right, upwards, halfWidth, halfHeight } = axesOf(camera);
  const towards = subtract(point, camera.origin);
  const depth = dot(towards, into);
  if (!(depth > 0)) return null;
  return [
    (1 + dot(towards, right) / depth / halfWidth) / 2,
    (1 - dot(towards, upwards) / depth / halfHeight) / 2,
  ];
}

/// Around look_at: `sideways` and `over` in radians; never past up.
export function orbited(camera, sideways, over) {
  const axis = unit(camera.up);
  let offset = rotated(subtract(camera.origin, camera.look_at), axis, sideways);
  const { right } = axesOf({ ...camera, origin: add(camera.look_at, offset) });
  const now = Math.acos(Math.max(-1, Math.min(1, dot(unit(offset), axis))));
  const then = Math.max(nearest_to_up, Math.min(Math.PI - nearest_to_up, now - over));
  offset = rotated(offset, right, now - then);
  return { ...camera, origin: add(camera.look_at, offset) };
}

/// The distance to look_at times `factor`.
export function dollied(camera, factor) {
  const offset = scale(subtract(camera.origin, camera.look_at), factor);
  return { ...camera, origin: add(camera.look_at, offset) };
}

/// `vector` turned about the unit vector `axis` (Rodrigues).
function rotated(vector, axis, angle) {
  const along = scale(axis, dot(axis, vector) * (1 - Math.cos(angle)));
  return add(add(scale(vector, Math.cos(angle)), scale(cross(axis, vector), Math.sin(angle))), along);
}
