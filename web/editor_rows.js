// A line as the editor paints it: its number, its colours, and what is wrong in it.
import { element } from "./element.js";
import { tokensOf } from "./json_tokens.js";

/// A map from the lines of marks to what is said of them.
export function messagesByLine(marks) {
  const messages = new Map();
  for (const { line, message } of marks) messages.set(line, [...(messages.get(line) ?? []), message]);
  return messages;
}

/// `wrong`: what is said of the line, if anything.
export function numberRow(line, isCurrent, wrong) {
  const row = element("div", {}, String(line));
  row.classList.toggle("current", isCurrent);
  row.classList.toggle("wrong", Boolean(wrong));
  if (wrong) row.title = wrong.join("\n");
  return row;
}

export function textRow(line, wrong) {
  const row = element("div");
  for (const { kind, text } of tokensOf(line)) {
    row.append(kind === "plain" ? text : element("span", { className: kind }, text));
  }
  if (wrong) {
    row.className = "wrong";
    row.append(element("em", {}, wrong.join("; ")));
  }
  return row;
}
