// What the page itself needs of a document: its camera, and what the form shows. A long text is read
// beside the page, by a worker, as it takes many times as long as a frame may.
import { cameraIn } from "./camera.js";

/// In characters: from here on, the page does nothing with a text at each movement of a hand.
export const long_text = 200_000;
const most_of_a_list = 16;     // of what an object has; the form needs points
const most_of_a_kind = 50;     // with a row each in the form; nobody moves more by hand

/// {camera, scene} of a document's text: the camera is null if the text has none, the scene has its
/// objects by their indices, without long lists, and counts of all there are by their types.
/// null: the text cannot be read.
export function outlineOf(text) {
  let scene;
  try {
    scene = JSON.parse(text);
  } catch {
    return null;
  }
  if (scene === null || typeof scene !== "object") return null;
  const { materials, lights, background, ambient } = scene;
  const counts = { light: listIn(lights).length, material: Object.keys(materials ?? {}).length };
  const objects = listIn(scene.objects).map((object, index) => [index, object])
    .filter(([, object]) => object && (counts[object.type] = (counts[object.type] ?? 0) + 1) <= most_of_a_kind)
    .map(([index, object]) => [index, withoutLists(object)]);
  return {
    camera: cameraIn(scene),
    scene: {
      background, ambient, counts, lights: listIn(lights).slice(0, most_of_a_kind), objects: Object.fromEntries(objects),
      materials: Object.fromEntries(Object.entries(materials ?? {}).slice(0, most_of_a_kind)),
    },
  };
}

/// A function that resolves to outlineOf(text), or to undefined if it is called again before that.
export function createReader() {
  let drop = () => {};

  return (text) => {
    drop();
    if (text.length < long_text) return Promise.resolve(outlineOf(text));
    return new Promise((resolve) => {
      const worker = new Worker("outline_worker.js", { type: "module" });
      const end = (outline) => {
        worker.terminate();
        resolve(outline);
      };
      drop = () => end(undefined);
      worker.onmessage = ({ data }) => end(data);
      worker.onerror = () => end(null);
      worker.postMessage(text);
    });
  };
}

// A mesh may be all of a long text, and its way from the worker to the page would take as long as the reading.
const withoutLists = (object) => Object.fromEntries(Object.entries(object).filter(([, value]) => !(Array.isArray(value) && value.length > most_of_a_list)));

const listIn = (value) => (Array.isArray(value) ? value : []);
