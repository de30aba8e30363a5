// The focus where a control goes: it would fall back to the page's beginning.

/// Before `leaving` is hidden or disabled: if it has the focus or holds it, `next` gets it.
export function passFocus(leaving, next) {
  if (leaving.contains(document.activeElement)) next.focus();
}
