// Moving a sphere by hand: its outline under the pointer, and its centre in the text as it is dragged.
import { add, length, scale, subtract } from "./camera.js";
import { rounded, withValue } from "./json_edit.js";
import { draggedCenter, outlineOf, sphereAt, spheresOf } from "./pick.js";

/// `outline`: an SVG polygon over the picture, in parts of it.
export function createSphereMover(outline) {
  let held = null;                        // {text, sphere, from}
  let known = { text: null, spheres: [] };

  function spheresIn(text) {
    if (known.text !== text) known = { text, spheres: spheresOf(text) };
    return known.spheres;
  }

  function show(camera, sphere) {
    const points = sphere ? outlineOf(camera, sphere) : [];
    outline.setAttribute("points", points.map((point) => point.join(",")).join(" "));
  }

  return {
    /// Outlines what is at (x, y); whether there is a sphere.
    point(camera, text, x, y) {
      const sphere = sphereAt(camera, spheresIn(text), x, y);
      show(camera, sphere);
      return sphere !== null;
    },

    grab(camera, text, x, y) {
      const sphere = sphereAt(camera, spheresIn(text), x, y);
      held = sphere && { text, sphere, from: [x, y] };
      return held !== null;
    },

    /// The text with the sphere where the pointer is now.
    drag(camera, x, y) {
      const { text, sphere, from } = held;
      // A pixel is some 1/700 of the picture; finer digits than a tenth of one mean nothing.
      const step = length(subtract(sphere.center, camera.origin)) / 7000;
      const center = draggedCenter(camera, sphere.center, from, [x, y]).map((value) => rounded(value, step));
      show(camera, { ...sphere, center });
      return withValue(text, `/objects/${sphere.index}/center`, center);
    },

    hide() {
      held = null;
      outline.setAttribute("points", "");
    },
  };
}

/// An object where the camera looks, of a size to be seen, or a sky beside the lights that are there.
export function newElement(type, { origin, look_at }) {
  if (type === "sky") return { type, intensity: 0.5 };
  const distance = length(subtract(look_at, origin));
  const step = distance / 100;
  const place = (height) => add(add(origin, scale(subtract(look_at, origin), 0.7)), [0, height, 0])
    .map((value) => rounded(value, step));
  const radius = rounded(distance / 12, step);
  if (type === "cylinder") return { type, from: place(-radius), to: place(radius), radius: rounded(radius / 2, step) };
  if (type === "cone") return { type, from: place(-radius), to: place(radius), radius_from: radius, radius_to: 0 };
  return { type, center: place(0), radius };
}
