// The shipped scenes as pictures to choose from; they are rendered when the gallery is opened, one
// after the other.
import { render } from "./api.js";
import { element } from "./element.js";

const thumbnail_px = 240;  // wide; shown at most that large

/// `dialog` holds a list; `opener` opens it. `current()` is the name of the scene in sight;
/// `onChoose(name)` follows a choice.
export function createGallery(dialog, opener, { scenes, current, onChoose }) {
  const list = dialog.querySelector("ul");
  let rendering = null;  // the AbortController of what is rendered while it is open

  // An img could not say who asks: see token.js.
  async function fill(pictures, signal) {
    for (const [index, picture] of pictures.entries()) {
      try {
        const { blob } = await render({ query: { scene: scenes[index].name, ...sizeOf(scenes[index]) } }, signal);
        picture.onload = () => URL.revokeObjectURL(picture.src);
        picture.src = URL.createObjectURL(blob);
      } catch (error) {
        if (signal.aborted) return;
        console.debug(error);  // the scene can be chosen without its picture
      }
    }
  }

  function card(scene) {
    const { name, title, description } = scene;
    const picture = element("img", { alt: "", ...sizeOf(scene) });
    const button = element("button", { type: "button" }, picture, element("strong", {}, title), " ", element("span", {}, description));
    button.dataset.scene = name;
    if (name === current()) button.setAttribute("aria-current", "true");
    button.addEventListener("click", () => {
      dialog.close();
      onChoose(name);
    });
    return element("li", {}, button);
  }

  opener.addEventListener("click", () => {
    list.replaceChildren(...scenes.map(card));
    dialog.showModal();
    list.querySelector("[aria-current]")?.focus();
    rendering = new AbortController();
    fill([...list.querySelectorAll("img")], rendering.signal);
  });
  dialog.addEventListener("close", () => rendering.abort());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();  // beside it
  });
}

function sizeOf({ width, height }) {
  return { width: thumbnail_px, height: Math.max(1, Math.round((thumbnail_px * height) / width)) };
}
