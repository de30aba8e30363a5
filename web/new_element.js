// What is added to a scene: where the camera looks, of a size to be seen, beside what is there.
import { add, axesOf, length, scale, subtract } from "./camera.js";
import { rounded } from "./json_edit.js";

const columns = [0, 1, -1];  // beside the middle, as far as most cameras see
const rows = 20;
const apart = 2.4;           // radii from one to the next

/// An object or a light of that type. `taken`: the objects and lights that are there.
export function newElement(type, camera, taken) {
  if (type === "sky") return { type, intensity: 0.5 };
  const { origin, look_at } = camera;
  const { into, right, upwards } = axesOf(camera);
  const distance = length(subtract(look_at, origin));
  const step = distance / 100;
  const along = (start, sideways, over, forwards) =>
    add(add(start, scale(right, sideways)), add(scale(upwards, over), scale(into, forwards)));
  const short = (vector, finest) => vector.map((value) => rounded(value, finest));
  if (type === "distant") return { type, direction: short(along([0, 0, 0], 0.5, -1, 1), 0.01), intensity: 0.5 };

  const radius = rounded(distance / 12, step);
  const centers = taken.map(centerOf).filter(Boolean);
  const isFree = (place) => centers.every((center) => length(subtract(center, place)) > 0.9 * apart * radius);
  function freeFrom(start) {
    let place = start;
    for (let row = 0; row < rows; row += 1) {
      for (const column of columns) {
        place = along(start, column * apart * radius, row * apart * radius, 0);
        if (isFree(place)) return place;
      }
    }
    return place;
  }

  if (type === "point") {
    const position = freeFrom(along(look_at, -0.3 * distance, 0.4 * distance, -0.3 * distance));
    const far = length(subtract(look_at, position));
    // Where the camera looks, as bright as a distant light of 1/2.
    return { type, position: short(position, step), intensity: Number((2 * Math.PI * far ** 2).toPrecision(2)) };
  }
  const center = freeFrom(along(origin, 0, 0, 0.7 * distance));
  const place = (height) => short(add(center, [0, height, 0]), step);
  if (type === "cylinder") return { type, from: place(-radius), to: place(radius), radius: rounded(radius / 2, step) };
  if (type === "cone") return { type, from: place(-radius), to: place(radius), radius_from: radius, radius_to: 0 };
  return { type, center: place(0), radius };
}

function centerOf(element) {
  const { center, from, to, position } = element ?? {};
  const isPoint = (value) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
  if (isPoint(from) && isPoint(to)) return scale(add(from, to), 0.5);
  return [center, position].find(isPoint);
}
