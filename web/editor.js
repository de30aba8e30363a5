// The scene's text: a textarea, with line numbers beside it and its colours painted behind it.
//
// The textarea keeps everything that a person expects of one (selection, undo, search, input
// methods); its own glyphs are transparent. Only the lines in sight are painted, so that a long
// document costs no more than a short one. Lines do not wrap: a line's place is its number times
// the line height.
import { element } from "./element.js";
import { lineAndColumn } from "./json_pointer.js";
import { tokensOf } from "./json_tokens.js";
import { editorKeys } from "./editor_keys.js";

const spare_lines = 8;  // painted above and below what is in sight

/// `box` holds #editor, #gutter and #paint. `onInput()` follows a change by the person;
/// `onMarksMoved()` follows a change of the lines of the marks.
export function createEditor(box, { onInput, onMarksMoved }) {
  const area = box.querySelector("textarea");
  const gutter = box.querySelector("#gutter");
  const paint = box.querySelector("#paint");
  let text = area.value;
  let lines = [""];
  let marks = [];  // {start, end, line, message}
  let caretLine = 1;

  function lineHeight() {
    return parseFloat(getComputedStyle(area).lineHeight);
  }

  function repaint() {
    const height = lineHeight();
    const first = Math.max(0, Math.floor(area.scrollTop / height) - spare_lines);
    const count = Math.ceil(area.clientHeight / height) + 2 * spare_lines;
    const messages = messagesByLine(marks);
    const numbers = [];
    const rows = [];
    for (let line = first + 1; line <= Math.min(lines.length, first + count); line += 1) {
      const wrong = messages.get(line);
      numbers.push(numberRow(line, line === caretLine, wrong));
      rows.push(textRow(lines[line - 1], wrong));
    }
    gutter.replaceChildren(...numbers);
    paint.replaceChildren(...rows);
    // Reading scrollWidth lays the page out: once, after all writing but the last.
    paint.style.width = `${area.scrollWidth}px`;
    const top = first * height - area.scrollTop;
    gutter.style.transform = `translateY(${top}px)`;
    paint.style.transform = `translate(${-area.scrollLeft}px, ${top}px)`;
  }

  // Scrolls to the first of `places` unless one of them is in sight.
  function showOneOf(places) {
    const inSight = ({ line }) => {
      const top = (line - 1) * lineHeight() - area.scrollTop;
      return top >= 0 && top < area.clientHeight - lineHeight();
    };
    if (places.length > 0 && !places.some(inSight)) scrollTo(places[0].line);
  }

  // A third of the way down, so that what is around the line is seen too.
  function scrollTo(line) {
    area.scrollTop = (line - 1) * lineHeight() - area.clientHeight / 3;
  }

  function take(next) {
    text = next;
    lines = text.split("\n");
    box.style.setProperty("--digits", String(lines.length).length);
  }

  area.addEventListener("input", () => {
    const before = text;
    take(area.value);
    if (marks.length > 0) {
      moveMarks(marks, before, text);
      onMarksMoved();
    }
    repaint();
    onInput();
  });
  area.addEventListener("scroll", repaint);
  area.addEventListener("mousemove", (event) => {
    const padding = parseFloat(getComputedStyle(area).paddingTop);
    const line = 1 + Math.floor((event.offsetY + area.scrollTop - padding) / lineHeight());
    area.title = marks.filter((mark) => mark.line === line).map((mark) => mark.message).join("\n");
  });
  document.addEventListener("selectionchange", () => {
    if (document.activeElement !== area) return;
    const { line, column } = lineAndColumn(text, area.selectionStart);
    document.querySelector("#caret").textContent = `${line}:${column}`;
    if (line === caretLine) return;
    caretLine = line;
    repaint();
  });
  new ResizeObserver(repaint).observe(area);
  editorKeys(area);

  return {
    get text() {
      return text;
    },

    /// Replaces the whole text; marks and undo history end with it.
    set text(next) {
      area.value = next;
      marks = [];
      caretLine = 1;
      take(area.value);
      area.setSelectionRange(0, 0);
      area.scrollTo(0, 0);
      repaint();
    },

    /// Another state of the same document: what is in sight stays so.
    revise(next) {
      const before = text;
      const { scrollTop, scrollLeft } = area;
      area.value = next;
      take(area.value);
      moveMarks(marks, before, text);
      area.scrollTo(scrollLeft, scrollTop);
      repaint();
    },

    /// Marks what is wrong in `about`, the text or a former state of it: [{start, end, line,
    /// message}]. The numbers are kept up to date with the text in the objects that were given.
    mark(next, about) {
      marks = next;
      if (about !== text) moveMarks(marks, about, text);
      showOneOf(marks);
      area.setAttribute("aria-invalid", String(marks.length > 0));
      area.title = "";
      repaint();
    },

    /// Selects from `start` to `end`, in sight and focused.
    reveal({ start, end }) {
      const { line, column } = lineAndColumn(text, start);
      area.focus();
      area.setSelectionRange(start, end);
      scrollTo(line);
      const columnWidth = area.scrollWidth / Math.max(80, ...lines.map((each) => each.length));
      area.scrollLeft = column * columnWidth < area.clientWidth * 0.8 ? 0 : (column - 20) * columnWidth;
    },
  };
}

function messagesByLine(marks) {
  const messages = new Map();
  for (const { line, message } of marks) messages.set(line, [...(messages.get(line) ?? []), message]);
  return messages;
}

function numberRow(line, isCurrent, wrong) {
  const row = element("div", {}, String(line));
  row.classList.toggle("current", isCurrent);
  row.classList.toggle("wrong", Boolean(wrong));
  if (wrong) row.title = wrong.join("\n");
  return row;
}

function textRow(line, wrong) {
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

/// An edit replaced one stretch of the text: a mark before it stays, one behind it moves along.
function moveMarks(marks, before, after) {
  const shorter = Math.min(before.length, after.length);
  let start = 0;
  while (start < shorter && before[start] === after[start]) start += 1;
  const growth = after.length - before.length;
  for (const mark of marks) {
    if (mark.start >= start) mark.start = Math.max(start, mark.start + growth);
    if (mark.end >= start) mark.end = Math.max(mark.start, mark.end + growth);
    mark.line = lineAndColumn(after, mark.start).line;
  }
}
