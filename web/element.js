// Making elements of the page.

/// A `tag` with these properties (textContent, className and so on) and children: elements or texts.
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
