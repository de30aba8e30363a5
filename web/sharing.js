// What leaves the page: a link to its state, and the command that renders the same picture.
import { curlCommand, fragmentOf } from "./share.js";

const longest_link = 1_000_000;  // Firefox follows none beyond 2^20 characters, Chromium none beyond twice that

/// `state()` gives {name, title, text, view, choice, settings, written}: `name` is empty where the text
/// is no shipped scene's; `written()` is the text with the view in it. `moveTo(fragment)`
/// changes the address, `say(words)` tells the person what happened.
export function createSharing({ share, curl, dialog }, { state, moveTo, say }) {
  share.addEventListener("click", async () => {
    const fragment = await fragmentOf(state());
    if (fragment.length > longest_link) return say("Too large for a link; share the JSON itself");
    // The address is the link too: for those who copy it from there.
    moveTo(fragment);
    if (await copy(location.href, dialog, "Link to this scene and view")) say("Link copied");
  });
  curl.addEventListener("click", async () => {
    const { written, settings, title } = state();
    if (await copy(curlCommand(written(), settings, title), dialog, "Command for this picture")) say("Command copied");
  });
}

// Resolves to whether `text` is in the clipboard; where the browser forbids it, `dialog` shows it selected.
async function copy(text, dialog, title) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    dialog.querySelector("h2").textContent = title;
    const area = dialog.querySelector("textarea");
    area.value = text;
    dialog.showModal();
    area.select();
    return false;
  }
}
