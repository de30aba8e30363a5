// Moving a sphere by hand: its outline under the pointer, and its centre in the text as it is dragged.
import { length, subtract } from "./camera.js";
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
      outline.setAttribute("points", "");
    },

    drop() {
      held = null;
      this.hide();
    },
  };
}
