// Before and after: a picture that was kept, over the picture in sight, with a slider between them.

/// `board` holds #before (an img), #split (a range), #before-label and #after-label; `button` keeps
/// the picture in sight, and lets go of it.
export function createCompare(board, button, { current }) {
  const [before, split, beforeLabel, afterLabel] = ["before", "split", "before-label", "after-label"].map((id) => board.querySelector(`#${id}`));
  const parts = [before, split, beforeLabel, afterLabel];
  let isOn = false;

  function place() {
    board.style.setProperty("--split", `${split.value}%`);
  }

  function setComparing(on) {
    isOn = on;
    button.setAttribute("aria-pressed", String(on));
    for (const part of parts) part.hidden = !on;
    if (!on) {
      URL.revokeObjectURL(before.src);
      before.removeAttribute("src");
    }
  }

  button.addEventListener("click", () => {
    const { blob, words } = current();
    setComparing(!isOn);
    if (!isOn) return;
    before.src = URL.createObjectURL(blob);
    beforeLabel.textContent = `Before: ${words}`;
    afterLabel.textContent = "After: change something";
    split.value = 50;
    place();
  });
  split.addEventListener("input", place);

  return {
    /// Another scene comes.
    end() {
      if (isOn) setComparing(false);
    },

    /// Another picture is in sight, made with these settings.
    after(words) {
      button.disabled = false;
      if (isOn) afterLabel.textContent = `After: ${words}`;
    },
  };
}
