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
  let kept = { text: null, name: null };

  async function keep(text, signal) {
    kept = { text, name: null };
    try {
      kept = { text, name: await keepScene(text, signal) };
    } catch (error) {
      if (error.status === too_large_to_keep) return;
      kept = { text: null, name: null };
      throw error;
    }
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
      if (!names.has(text) && kept.text !== text) await keep(text, signal);
      const scene = names.get(text) ?? kept.name;
      if (scene === null) return work({ query: settings, body: withView(text, view) });
      const asked = (name) => work({ query: { scene: name, ...viewQuery(view), ...settings } });
      try {
        return await asked(scene);
      } catch (error) {
        if (!(error instanceof Problem) || error.status !== 404 || names.has(text)) throw error;
        await keep(text, signal);
        return asked(kept.name);
      }
    },
  };
}
