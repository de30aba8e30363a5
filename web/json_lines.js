// A JSON text as people write it, of one that a program has written on a line.
import { longest_painted } from "./json_tokens.js";

const levels_on_lines = 2;  // the document's members, and the elements or members of these
const strings_and_marks = /"[^"\\]*(?:\\.[^"\\]*)*"|[{}[\],]/g;

/// `text` with each member of the document on a line of its own, each element of a member, and each of what is
/// too long for a line. Only space between values changes.
export function withLines(text) {
  const isBroken = brokenIn(text);
  const open = [];  // whether what is around this place is broken into lines
  let made = "";
  let level = 0;
  let from = 0;
  let isEmpty = false;  // what was opened last, so far
  const line = () => `\n${"  ".repeat(level)}`;
  for (const { 0: mark, index } of text.matchAll(strings_and_marks)) {
    if (mark[0] === '"') continue;
    if (isOpening(mark)) open.push(isBroken.has(index));
    const ends = open.at(-1);
    if (isClosing(mark)) open.pop();
    if (!ends) continue;
    const piece = text.slice(from, index).trim();
    from = index + 1;
    if (isOpening(mark)) level += 1;
    if (isClosing(mark)) {
      level -= 1;
      made = isEmpty && piece === "" ? made.trimEnd() + mark : made + piece + line() + mark;
    } else {
      made += piece + mark + line();
    }
    isEmpty = isOpening(mark);
  }
  return `${made}${text.slice(from).trim()}\n`;
}

// Where containers open that are to be broken into lines.
function brokenIn(text) {
  const broken = new Set();
  const open = [];
  for (const { 0: mark, index } of text.matchAll(strings_and_marks)) {
    if (isOpening(mark)) {
      open.push(index);
      if (open.length <= levels_on_lines) broken.add(index);
    } else if (isClosing(mark)) {
      const opened = open.pop();
      if (index - opened > longest_painted) broken.add(opened);
    }
  }
  return broken;
}

const isOpening = (mark) => mark === "{" || mark === "[";
const isClosing = (mark) => mark === "}" || mark === "]";
