// The shipped scenes as pictures to choose from; they are rendered when the gallery is first opened.
import { element } from "./element.js";

const thumbnail_px = 240;  // wide; shown at most that large

/// `dialog` holds a list; `opener` opens it. `current()` is the name of the scene in sight;
/// `onChoose(name)` follows a choice.
export function createGallery(dialog, opener, { scenes, current, onChoose }) {
  const list = dialog.querySelector("ul");

  function card({ name, title, description, width, height }) {
    const tall = Math.max(1, Math.round((thumbnail_px * height) / width));
    const picture = element("img", {
      alt: "", loading: "lazy", width: thumbnail_px, height: tall,
      src: `render?${new URLSearchParams({ scene: name, width: thumbnail_px, height: tall })}`,
    });
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
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();  // beside it
  });
}
