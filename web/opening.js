// Which scene is open: one of the server's, a link's, a file's, or what the page had when it was left;
// and what becomes of the edits of the one before.
import { sceneText } from "./api.js";
import { createAside } from "./aside.js";
import { createSceneList } from "./scene_list.js";
import { fragmentOf, readFragment } from "./share.js";
import { keepEdits } from "./unsaved.js";

const first_scene = "demo";

/// `elements`: those of scene_list.js, and {restore}, which brings edits back. `view()` is what the hand
/// made of the camera, or null. `onLoading(name)` comes first; `begin(text, signal, view, former)` shows a
/// scene, with `former` for Undo to go back to, or null; `onBring(text)` follows edits that are brought back.
export function createOpening({ restore, ...elements }, { editor, source, accuracy, view, onLoading, begin, onBring }) {
  let loaded = { name: first_scene, text: "" };  // what the text began as; name "": it came in a link or a file
  let isBegun = false;                           // there is a text to render
  let address = "";                              // of what is open
  let latest = null;                             // the load that began last
  let askedChoice = {};                          // of the accuracy, by the address
  let left = keepEdits(() => left ?? edits(), ({ text, aside }) => text !== null || [aside ?? []].flat().length > 0);  // what is to be brought back
  if (left?.choice && left.hash === location.hash) accuracy.choice = left.choice;

  const scenes = createSceneList(elements, {
    current: () => loaded.name,
    onChoose(name) {
      location.hash = new URLSearchParams({ scene: name });
    },
  });
  const aside = createAside(restore, elements.select, {
    current: unsaved,
    async onBring({ loaded: former, text }) {
      const fragment = await fragmentOf({ ...former, view: null, choice: accuracy.choice });
      latest = null;
      loaded = former;
      scenes.choose(loaded.name);
      moveTo(fragment);
      onBring(text);
    },
  });

  function unsaved() {
    return editor.text === loaded.text ? null : { loaded, text: editor.text };
  }

  function edits() {
    const text = unsaved()?.text ?? null;
    const { choice } = accuracy;
    const isAsAsked = JSON.stringify(choice) === JSON.stringify(askedChoice);
    if (text === null && view() === null && aside.edits.length === 0 && isAsAsked) return null;
    return { hash: address, name: loaded.name, text, view: view(), choice, aside: aside.edits };
  }

  function replaceAddress(fragment) {
    history.replaceState(null, "", fragment || location.pathname + location.search);
    address = location.hash;
  }

  // To a fragment with what is chosen.
  function moveTo(fragment) {
    replaceAddress(fragment);
    askedChoice = accuracy.choice;
  }

  // What the address says: {asked, name, text}, and what goes {back} to it.
  async function find(signal) {
    await scenes.load();
    signal.throwIfAborted();
    const asked = await readFragment(location.hash || location.search);  // /?scene=glass, typed by hand, counts too
    const back = left?.hash === location.hash ? left : null;
    const isOwn = asked.text !== null || Boolean(back?.text && back.name === "");  // a link's, or of a file that was opened here
    const name = isOwn ? "" : asked.name || first_scene;
    onLoading(name || "your scene");
    scenes.choose(name);
    const text = asked.text ?? (isOwn ? "" : await sceneText(name, signal));
    signal.throwIfAborted();
    return { asked, back, name, text };
  }

  // Another scene comes; it may go on with what the page left when it was last here.
  function layAside(goesOn) {
    const edit = unsaved();
    if (edit) aside.add(edit);
    if (!left) return;
    const { name, text, aside: others } = left;
    aside.add(...[others ?? []].flat());
    if (text !== null && !goesOn) aside.add({ loaded: { name, text: "" }, text });
    left = null;
  }

  return {
    /// "": no scene of the server's.
    get name() {
      return loaded.name;
    },
    get isBegun() {
      return isBegun;
    },
    get isEdited() {
      return unsaved() !== null;
    },

    /// The address is another one of what is open.
    moveTo,

    /// Opens what the address says. Resolves, when begin() has, to whether edits of it {areBack} and the
    /// link {isDamaged}. Where it fails or ends, the scene before stays open, and the page says so.
    async load(signal) {
      const mine = {};
      latest = mine;
      const { asked, back, name, text } = await find(signal).catch((error) => {
        if (latest === mine) {  // what is open stays so
          scenes.choose(isBegun ? loaded.name : null);
          if (isBegun) replaceAddress(address);
        }
        throw error;
      });
      layAside(back !== null);
      loaded = { name, text };
      if (name) source.know(name, text);
      askedChoice = asked.choice;
      if (!back?.choice && Object.keys(asked.choice).length > 0) accuracy.choice = asked.choice;
      const areBack = Boolean(text && back?.text && back.text !== text);
      isBegun = true;
      address = location.hash;
      await begin(back?.text ?? text, signal, back ? back.view : asked.view, areBack ? text : null);
      return { areBack, isDamaged: asked.isDamaged };
    },

    /// Opens a file that was chosen or dropped, whose text no address has: for the tab it is an edit, which it keeps.
    async take(text, file, signal) {
      onLoading(file);
      layAside(false);
      latest = null;
      askedChoice = {};
      loaded = { name: "", text: "" };
      if (location.hash) history.pushState(null, "", location.pathname + location.search);  // Back leads to the scene before
      address = location.hash;
      scenes.choose("");
      isBegun = true;
      await begin(text, signal, null, null);
    },
  };
}
