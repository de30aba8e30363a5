// Where in a JSON text the value of a JSON Pointer (RFC 6901) stands.
//
// JSON.parse forgets positions, so the text is scanned once into a tree of them. The scanner
// checks nothing: it is for text that the server has read, and on any other it ends early, with
// the places found so far. It keeps its own stack, so deep nesting is harmless.

const token = /[\s,:]*(?:("[^"\\]*(?:\\.[^"\\]*)*")|([{}[\]])|([^\s{}[\],:"]+))/gy;

/// A function from pointers into `text` to places in it:
///   value: {start, end}, offsets of the value, or, if it is missing, of the object or array
///          that it is missing from (of a container, its opening bracket alone);
///   key:   {start, end} of the member's name, or null: the root, an array's element, missing.
///   whole: {start, end} of the value with all that is in it, or null if it is missing.
/// Of duplicate keys, the last one counts.
export function locator(text) {
  const root = positionsIn(text);
  return (pointer) => {
    let node = root;
    for (const name of partsOfPointer(pointer)) {
      const child = node.children?.get(name);
      if (!child) return { value: placeOf(node), key: null, whole: null };
      node = child;
    }
    return { value: placeOf(node), key: node.key, whole: { start: node.start, end: node.close ?? node.end } };
  };
}

/// The names and indices of a pointer, as they are written in a document.
export function partsOfPointer(pointer) {
  return pointer.split("/").slice(1).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
}

/// The line and the column, from 1, of an offset; columns count UTF-16 units, as offsets do.
export function lineAndColumn(text, offset) {
  let line = 1;
  let lineStart = 0;
  for (let at = text.indexOf("\n"); at !== -1 && at < offset; at = text.indexOf("\n", at + 1)) {
    line += 1;
    lineStart = at + 1;
  }
  return { line, column: offset - lineStart + 1 };
}

/// The offset of a line and column, from 1; the nearest there is if the text has no such place.
export function offsetOf(text, line, column) {
  let lineStart = 0;
  for (let number = 1; number < line; number += 1) {
    const lineEnd = text.indexOf("\n", lineStart);
    if (lineEnd === -1) break;
    lineStart = lineEnd + 1;
  }
  const lineEnd = text.indexOf("\n", lineStart);
  return Math.min(lineStart + column - 1, lineEnd === -1 ? text.length : lineEnd);
}

function placeOf({ start, end }) {
  return { start, end };
}

// A node is {start, end, key, children: Map of name to node, or undefined for a scalar}.
function positionsIn(text) {
  let root = { start: 0, end: 0, key: null };
  const open = [];  // the containers around the scanner's place
  let key = null;   // a name whose value is still to come
  token.lastIndex = 0;
  for (let match = token.exec(text); match; match = token.exec(text)) {
    const [, string, bracket] = match;
    const end = token.lastIndex;
    const start = end - (string ?? bracket ?? match[3]).length;
    const parent = open.at(-1);
    if (bracket === "}" || bracket === "]") {
      const closed = open.pop();
      if (closed) closed.close = end;
      if (open.length === 0) break;
    } else if (string && parent?.isObject && !key) {
      key = { start, end, name: nameOf(string) };
    } else {
      const node = { start, end, key: key && { start: key.start, end: key.end } };
      if (parent) parent.children.set(key ? key.name : String(parent.children.size), node);
      else root = node;
      key = null;
      if (!bracket) continue;
      node.children = new Map();
      node.isObject = bracket === "{";
      open.push(node);
    }
  }
  return root;
}

function nameOf(string) {
  try {
    return JSON.parse(string);
  } catch {
    return string.slice(1, -1);
  }
}
