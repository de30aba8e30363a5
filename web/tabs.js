// Tabs as the ARIA practices describe them: one in the order of Tab, arrows between them.

/// `list` has role tablist; each tab's aria-controls is its panel's id. Returns choose(id).
export function createTabs(list) {
  const tabs = [...list.querySelectorAll("[role=tab]")];

  function choose(id) {
    for (const tab of tabs) {
      const isChosen = tab.id === id;
      tab.setAttribute("aria-selected", String(isChosen));
      tab.tabIndex = isChosen ? 0 : -1;
      document.getElementById(tab.getAttribute("aria-controls")).hidden = !isChosen;
    }
  }

  list.addEventListener("click", (event) => {
    const tab = event.target.closest("[role=tab]");
    if (tab) choose(tab.id);
  });
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = tabs[(tabs.indexOf(document.activeElement) + step + tabs.length) % tabs.length];
    choose(next.id);
    next.focus();
  });
  return choose;
}
