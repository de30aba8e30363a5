// Text for the clipboard; where the browser withholds it, a dialog from which to take the text.

/// Resolves to whether it is in the clipboard; else `dialog` shows it, selected.
export async function copy(text, dialog, title) {
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
