// The server's scenes to choose from, by name or by picture.
import { listScenes } from "./api.js";
import { element } from "./element.js";
import { createGallery } from "./gallery.js";

/// `about` describes what `select` shows; `opener` opens the `gallery`. `current()` is the name of the
/// scene in sight; `onChoose(name)` follows a choice.
export function createSceneList({ select, about, gallery, opener }, { current, onChoose }) {
  let coming = null;  // the promise of the list

  const optionOf = (name, title, description) => {
    const option = element("option", { value: name }, title);
    option.dataset.description = description;
    return option;
  };

  // Of a scene that the server does not list it knows no more; null: there is none.
  function choose(name) {
    const options = [...select.options];
    if (name === null) {
      options.find(({ value }) => value === "")?.remove();
      select.selectedIndex = -1;
      about.textContent = "";
      return;
    }
    const own = options.find(({ value }) => value === "");
    let option = name && options.find(({ value }) => value === name);
    if (option) {
      own?.remove();  // no address has what it stood for
    } else {
      option = own ?? optionOf("", "A scene of your own", "A scene from a link or a file.");
      select.prepend(option);
    }
    option.selected = true;
    about.textContent = option.dataset.description;
  }

  function show(scenes) {
    select.replaceChildren(...scenes.map(({ name, title, description }) => optionOf(name, title, description)));
    choose(current());
    createGallery(gallery, opener, { scenes, current, onChoose });
    opener.disabled = false;
  }

  select.addEventListener("change", () => onChoose(select.value));

  return {
    choose,
    /// Resolves when the list is there. It is asked for once, and again where it did not come.
    load() {
      coming ??= listScenes().then(show).catch((error) => {
        coming = null;
        throw error;
      });
      return coming;
    },
  };
}
