// Changes of a JSON text that leave the rest of it as its author wrote it.
import { locator, partsOfPointer } from "./json_pointer.js";

/// `text` with `value` where `pointer` points; a member that is missing is added after the last one
/// of its object. A pointer whose parent is missing changes nothing.
export function withValue(text, pointer, value) {
  const place = locator(text);
  const { whole } = place(pointer);
  if (whole) return spliced(text, whole, written(value));
  const parent = place(pointer.slice(0, pointer.lastIndexOf("/"))).whole;
  if (!parent || text[parent.start] !== "{") return text;
  return withMember(text, parent, `${JSON.stringify(partsOfPointer(pointer).at(-1))}: ${written(value)}`);
}

/// `text` with `value` as the last element of the array at `pointer`, which is added if it is missing.
export function withElement(text, pointer, value) {
  const { whole } = locator(text)(pointer);
  if (!whole) return withValue(text, pointer, [value]);
  return text[whole.start] === "[" ? withMember(text, whole, written(value)) : text;
}

/// `text` without the element `index` of the array at `pointer`.
export function withoutElement(text, pointer, index) {
  const place = locator(text);
  const { whole } = place(`${pointer}/${index}`);
  if (!whole) return text;
  const next = place(`${pointer}/${index + 1}`).whole;
  if (next) return spliced(text, { start: whole.start, end: next.start }, "");
  const former = index > 0 && place(`${pointer}/${index - 1}`).whole;
  return spliced(text, { start: former ? former.end : whole.start, end: whole.end }, "");
}

// Before the closing bracket of `container`, as its other members stand: each on its line, or all on one.
function withMember(text, container, member) {
  if (!/[}\]]/.test(text[container.end - 1])) return text;  // it is not closed: where it ends is not known
  const inside = text.slice(container.start + 1, container.end - 1);
  const end = container.start + 1 + inside.trimEnd().length;
  const isEmpty = inside.trim() === "";
  const lead = /^\s*/.exec(inside)[0];
  const separator = isEmpty ? "" : `,${lead.includes("\n") ? lead.slice(lead.lastIndexOf("\n")) : " "}`;
  return spliced(text, { start: end, end }, separator + member);
}

function spliced(text, { start, end }, inserted) {
  return text.slice(0, start) + inserted + text.slice(end);
}

/// JSON on one line, with spaces where people put them.
function written(value) {
  if (Array.isArray(value)) return `[${value.map(written).join(", ")}]`;
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  return `{ ${Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}: ${written(each)}`).join(", ")} }`;
}

/// The number of fewest digits within half of `step` of `value`, or within 1/2: what a hand means.
export function rounded(value, step) {
  const places = Math.max(0, Math.ceil(-Math.log10(Math.abs(step))));
  if (places <= 20) return Number(value.toFixed(places));
  const digits = places + Math.floor(Math.log10(Math.abs(value))) + 1;  // that stand before that place
  return digits >= 1 ? Number(value.toPrecision(Math.min(17, digits))) : 0;
}
