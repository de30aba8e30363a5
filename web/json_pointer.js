// Where in a JSON text the value of a JSON Pointer (RFC 6901) stands.
//
// JSON.parse forgets positions, so the text is scanned for them: only what a pointer leads through
// is looked into, since most of a long text is beside it. The scanner checks nothing: it is for text
// that the server has read, and on any other it ends early, with the places found so far. It counts
// brackets, so deep nesting is harmless.

/// A function from pointers into `text` to places in it:
///   value: {start, end}, offsets of the value, or, if it is missing, of the object or array
///          that it is missing from (of a container, its opening bracket alone);
///   key:   {start, end} of the member's name, or null: the root, an array's element, missing.
///   whole: {start, end} of the value with all that is in it, or null if it is missing.
/// Of duplicate keys, the last one counts.
export function locator(text) {
  const root = valueFrom(text, pastSeparators(text, 0), null);
  return (pointer) => {
    let node = root;
    for (const name of partsOfPointer(pointer)) {
      node.inside ??= text[node.start] === "{" ? membersOf(text, node) : elementsOf(text, node);
      const child = node.inside(name);
      if (!child) return { value: placeOf(node), key: null, whole: null };
      node = child;
    }
    return { value: placeOf(node), key: node.key, whole: { start: node.start, end: node.wholeEnd } };
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

// A node is {start, end, wholeEnd, key, inside}: the last a function from names to nodes, once it was asked for.
function valueFrom(text, start, key) {
  const wholeEnd = valueEnd(text, start);
  return { start, end: isOpening(text.charCodeAt(start)) ? start + 1 : wholeEnd, wholeEnd, key, inside: null };
}

function membersOf(text, { start, wholeEnd }) {
  const members = new Map();
  const isOver = (at) => at >= wholeEnd || isClosing(text.charCodeAt(at));
  for (let at = pastSeparators(text, start + 1); !isOver(at);) {
    const key = { start: at, end: valueEnd(text, at) };
    at = pastSeparators(text, key.end);
    if (isOver(at)) break;
    const member = valueFrom(text, at, key);
    members.set(nameOf(text.slice(key.start, key.end)), member);
    at = pastSeparators(text, member.wholeEnd);
  }
  return (name) => members.get(name);
}

// A scalar has none.
function elementsOf(text, { start, wholeEnd }) {
  const elements = [];
  if (text[start] !== "[") return () => undefined;
  for (let at = pastSeparators(text, start + 1); at < wholeEnd && !isClosing(text.charCodeAt(at));) {
    const element = valueFrom(text, at, null);
    elements.push(element);
    at = pastSeparators(text, element.wholeEnd);
  }
  return (name) => (/^\d+$/.test(name) ? elements[name] : undefined);
}

const [quote, backslash, comma, colon, openBracket, closeBracket, openBrace, closeBrace] = [...'"\\,:[]{}'].map((each) => each.charCodeAt(0));
const isOpening = (code) => code === openBracket || code === openBrace;
const isClosing = (code) => code === closeBracket || code === closeBrace;
const isSeparator = (code) => code <= 32 || code === comma || code === colon || code === 0xfeff;  // a byte order mark

function pastSeparators(text, at) {
  while (at < text.length && isSeparator(text.charCodeAt(at))) at += 1;
  return at;
}

// Where the value that starts at `at` ends: a container behind its bracket, or with the text. Whatever
// stands there, it has a character.
function valueEnd(text, at) {
  let depth = 0;
  do {
    const code = text.charCodeAt(at);
    if (code === quote) at = stringEnd(text, at);
    else if (isOpening(code) || isClosing(code)) {
      depth += isOpening(code) ? 1 : -1;
      at += 1;
    } else if (depth > 0) at += 1;
    else at = scalarEnd(text, at);
  } while (depth > 0 && at < text.length);
  return Math.min(at, text.length);
}

function stringEnd(text, start) {
  for (let at = start + 1; at < text.length; at += 1) {
    const code = text.charCodeAt(at);
    if (code === backslash) at += 1;
    else if (code === quote) return at + 1;
  }
  return text.length;
}

function scalarEnd(text, start) {
  let at = start + 1;
  for (; at < text.length; at += 1) {
    const code = text.charCodeAt(at);
    if (isSeparator(code) || isOpening(code) || isClosing(code) || code === quote) break;
  }
  return at;
}

function nameOf(string) {
  try {
    return JSON.parse(string);
  } catch {
    return string.slice(1, -1);
  }
}
