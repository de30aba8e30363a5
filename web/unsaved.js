// Edits survive a reload: when the page is left, the tab keeps them, and the page that comes next in
// it brings them back, as it does when a closed tab is opened again.
import { keepInTab, keptInTab } from "./tab_memory.js";

/// `state()` gives what to keep, of what JSON can say, or null; `isWork(state)`: whether a person should be asked
/// before it is lost. Returns what was kept before.
export function keepEdits(state, isWork) {
  const keep = (event) => {
    const edits = state();
    if (edits !== null && keepInTab("edits", JSON.stringify(edits))) return;
    keepInTab("edits", null);  // an older state would come as a surprise
    if (edits !== null && isWork(edits)) event.preventDefault();  // of beforeunload: the browser asks whether to leave
  };
  for (const leaving of ["beforeunload", "pagehide"]) window.addEventListener(leaving, keep);
  // A phone may end a page that is out of sight without a further word.
  document.addEventListener("visibilitychange", (event) => {
    if (document.hidden) keep(event);
  });
  return JSON.parse(keptInTab("edits"));
}
