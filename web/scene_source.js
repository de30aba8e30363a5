// How the server is told which scene to render. A shipped scene has a name; any other is posted
// once and then has one too, so that a view of it is a URL. A server that keeps none of a
// document's size gets the document itself each time.
import { keepScene, Problem } from "./api.js";
import { withView } from "./view.js";

const too_large_to_keep = 413;

/// The camera's part of a query: what differs from the document.
export function viewQuery(view) {
  if (!view) return {};
  return { origin: view.origin.join(","), look_at: view.look_at.join(","), up: view.up.join(",") };
}

export function createSource() {
  const names = new Map();  // text to name, of the shipped scenes
  let kept = { text: null, name: null };  // its name is a promise; of null where the server keeps none so large

  // Whoever asks next wants it too, so that nobody's signal ends it.
  function keep(text) {
    const name = keepScene(text).catch((error) => {
      if (error.status === too_large_to_keep) return null;
      if (kept.name === name) kept = { text: null, name: null };
      throw error;
    });
    kept = { text, name };
  }

  // The name of `text`, unless `signal` ends the waiting for it.
  function nameOf(text, signal) {
    if (kept.text !== text) keep(text);
    return new Promise((resolve, reject) => {
      signal.addEventListener("abort", () => reject(signal.reason), { once: true });
      kept.name.then(resolve, reject);
    });
  }

  return {
    /// `text` is the document of the shipped scene `name`.
    know(name, text) {
      names.set(text, name);
    },

    /// Whether the server has `text`, as far as this page knows.
    knows(text) {
      return names.has(text) || kept.text === text;
    },

    /// What `work(what)` gives, with `what` as api.js takes it. The server may have forgotten a
    /// scene, for want of memory or because it was started anew: it is posted again then, once.
    async with(text, view, settings, signal, work) {
      const scene = names.get(text) ?? (await nameOf(text, signal));
      if (scene === null) return work({ query: settings, body: withView(text, view) });
      const asked = (name) => work({ query: { scene: name, ...viewQuery(view), ...settings } });
      try {
        return await asked(scene);
      } catch (error) {
        if (!(error instanceof Problem) || error.status !== 404 || names.has(text)) throw error;
        keep(text);
        return asked(await nameOf(text, signal));
      }
    },
  };
}
