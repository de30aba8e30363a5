// Which sphere of the document is under the pointer, its outline, and where a drag takes it.
import { add, cross, dot, length, rayThrough, scale, seenAt, subtract, unit } from "./camera.js";

const corners = 64;  // of an outline

/// [{index, center, radius}] of the document's single spheres; [] if it cannot be read.
export function spheresOf(text) {
  try {
    return JSON.parse(text).objects.flatMap(({ type, center, radius }, index) =>
      type === "sphere" && Array.isArray(center) && radius > 0 ? [{ index, center, radius }] : []);
  } catch {
    return [];
  }
}

/// The nearest of `spheres` that the ray through (x, y) meets, or null.
export function sphereAt(camera, spheres, x, y) {
  const ray = rayThrough(camera, x, y);
  let nearest = null;
  let nearestAt = Infinity;
  for (const sphere of spheres) {
    const towards = subtract(sphere.center, camera.origin);
    const along = dot(towards, ray);
    const miss = length(subtract(towards, scale(ray, along)));
    if (along <= 0 || miss > sphere.radius) continue;
    const at = along - Math.sqrt(sphere.radius ** 2 - miss ** 2);
    if (at <= 0 || at >= nearestAt) continue;
    nearest = sphere;
    nearestAt = at;
  }
  return nearest;
}

/// Where a sphere's centre goes when the pointer goes from `from` to `to`: as far off as it was.
export function draggedCenter(camera, center, from, to) {
  const into = unit(subtract(camera.look_at, camera.origin));
  const depth = dot(subtract(center, camera.origin), into);
  const onPlane = ([x, y]) => {
    const ray = rayThrough(camera, x, y);
    return scale(ray, depth / dot(ray, into));
  };
  return add(center, subtract(onPlane(to), onPlane(from)));
}

/// The sphere's outline as (x, y) in parts of the picture: the circle in which a cone from the eye
/// touches it. [] from inside of it, or where a part is behind the eye.
export function outlineOf(camera, { center, radius }) {
  const towards = subtract(center, camera.origin);
  const distance = length(towards);
  if (distance <= radius) return [];
  const part = 1 - (radius / distance) ** 2;
  const middle = add(camera.origin, scale(towards, part));
  const axis = unit(towards);
  const aside = unit(cross(axis, Math.abs(axis[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
  const upwards = cross(axis, aside);
  const wide = radius * Math.sqrt(part);
  const points = [];
  for (let corner = 0; corner < corners; corner += 1) {
    const angle = (2 * Math.PI * corner) / corners;
    const rim = add(scale(aside, wide * Math.cos(angle)), scale(upwards, wide * Math.sin(angle)));
    const seen = seenAt(camera, add(middle, rim));
    if (!seen) return [];
    points.push(seen);
  }
  return points;
}
