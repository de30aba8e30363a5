// The shipped scenes as pictures to choose from; they are rendered when the gallery is first opened.

const thumbnail_px = 240;  // wide; shown at most that large

/// `dialog` holds a list; `opener` opens it. `current()` is the name of the scene in sight;
/// `onChoose(name)` follows a choice.
export function createGallery(dialog, opener, { scenes, current, onChoose }) {
  const list = dialog.querySelector("ul");

  function card({ name, title, description, width, height }) {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.scene = name;
    const picture = document.createElement("img");
    const tall = Math.max(1, Math.round((thumbnail_px * height) / width));
    Object.assign(picture, { alt: "", loading: "lazy", width: thumbnail_px, height: tall });
    picture.src = `render?${new URLSearchParams({ scene: name, width: thumbnail_px, height: tall })}`;
    const heading = document.createElement("strong");
    heading.textContent = title;
    const text = document.createElement("span");
    text.textContent = description;
    button.append(picture, heading, " ", text);
    if (name === current()) button.setAttribute("aria-current", "true");
    button.addEventListener("click", () => {
      dialog.close();
      onChoose(name);
    });
    item.append(button);
    return item;
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
