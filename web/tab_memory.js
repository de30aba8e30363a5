// What this tab keeps when its page is loaded anew, and no other tab or visit sees.

/// null: nothing was kept under that name.
export function keptInTab(name) {
  try {
    return sessionStorage.getItem(name);
  } catch {
    return null;  // the person has told the browser to keep nothing
  }
}

/// Whether the browser keeps `text`: it may be too long. null forgets.
export function keepInTab(name, text) {
  try {
    if (text === null) sessionStorage.removeItem(name);
    else sessionStorage.setItem(name, text);
    return true;
  } catch {
    return false;
  }
}
