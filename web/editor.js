// The scene's text: a textarea, with line numbers beside it and its colours painted behind it.
//
// The textarea keeps everything that a person expects of one (selection, undo, search, input
// methods); its own glyphs are transparent. Only the lines in sight are painted, so that a long
// document costs no more than a short one. Lines do not wrap: a line's place is its number times
// the line height. For the same reason the textarea holds a part of a long text, which follows the
// scrolling: browsers lay out all that is in a textarea, at each key.
import { lineAndColumn } from "./json_pointer.js";
import { concernsCaret, editorKeys } from "./editor_keys.js";
import { moveMarks } from "./editor_marks.js";
import { messagesByLine, numberRow, textRow } from "./editor_rows.js";

const spare_lines = 8;        // painted above and below what is in sight
const most_held = 40_000;     // characters that the textarea is given; it may grow to twice as many

/// `box` holds #editor, #gutter and #paint. `onInput(former, isUndone)` follows a change by the person,
/// before one that the textarea cannot undo goes `onReplace()`; `onUndo(isRedo)` follows the keys for it where
/// the textarea has nothing to undo; `onMarksMoved()` follows a change of the lines of the marks.
export function createEditor(box, { onInput, onReplace, onUndo, onMarksMoved }) {
  const area = box.querySelector("textarea");
  const gutter = box.querySelector("#gutter");
  const paint = box.querySelector("#paint");
  let text = area.value;
  let lines = [""];     // that the textarea holds
  let before = "";      // what stands before them in the text
  let after = "";       // and behind them
  let beforeLines = 0;  // the number of lines of that
  let away = null;      // {start, end, shown}: of a selection in the text that is not held, and what stands for it
  let isUntouched = true;  // nothing was typed since the textarea was given its part
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
    for (let index = first; index < Math.min(lines.length, first + count); index += 1) {
      const line = beforeLines + index + 1;
      const wrong = messages.get(line);
      numbers.push(numberRow(line, line === caretLine, wrong));
      rows.push(textRow(lines[index], wrong));
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
      const top = (line - 1 - beforeLines) * lineHeight() - area.scrollTop;
      return top >= 0 && top < area.clientHeight - lineHeight();
    };
    if (places.length > 0 && !places.some(inSight)) scrollTo(places[0]);
  }

  // A third of the way down, so that what is around the line is seen too.
  function scrollTo({ start, line }) {
    if (start < before.length || start > text.length - after.length) {
      const selected = selection();
      hold(start);
      select(selected);
    }
    area.scrollTop = (line - 1 - beforeLines) * lineHeight() - area.clientHeight / 3;
  }

  function take(next) {
    text = next;
    lines = area.value.split("\n");
  }

  // Gives the textarea the part of the text around this one, in whole lines if they are not too long.
  function hold(from, to = from) {
    let start = 0;
    let end = text.length;
    const size = Math.max(most_held, to - from);
    if (text.length > size) {
      start = Math.max(0, Math.min(Math.round((from + to - size) / 2), text.length - size));
      end = start + size;
      const lineStart = start === 0 ? 0 : text.lastIndexOf("\n", start - 1) + 1;
      const lineEnd = text.indexOf("\n", end);
      if (start - lineStart < most_held / 2) start = lineStart;
      if (lineEnd !== -1 && lineEnd - end < most_held / 2) end = lineEnd + 1;
    }
    before = text.slice(0, start);
    after = text.slice(end);
    beforeLines = linesIn(before);
    area.value = text.slice(start, end);
    isUntouched = true;
    take(text);
    box.style.setProperty("--digits", String(beforeLines + lines.length + linesIn(after)).length);
  }

  // Like hold(), but what is in sight and what is selected stay so.
  function holdInSight(offset) {
    const { scrollTop, scrollLeft } = area;
    const [isAll, selected, formerLines] = [isAllSelected(), selection(), beforeLines];
    hold(offset);
    if (isAll) area.setSelectionRange(0, area.value.length);
    else select(selected);
    area.scrollTo(scrollLeft, scrollTop + (formerLines - beforeLines) * lineHeight());
  }

  const isAway = () => away !== null && area.selectionStart === away.shown[0] && area.selectionEnd === away.shown[1];
  const selection = () => (isAway() ? away : { start: before.length + area.selectionStart, end: before.length + area.selectionEnd });

  // Selects so in the text; of what is not held, the nearest end.
  function select({ start, end }) {
    const shown = [start, end].map((each) => Math.max(0, Math.min(area.value.length, each - before.length)));
    area.setSelectionRange(...shown);
    const isHeld = shown[0] === start - before.length && shown[1] === end - before.length;
    away = isHeld ? null : { start, end, shown };
  }

  // To where the selection is, however far the text has been scrolled since.
  function comeBack() {
    if (isAway()) goTo(away);
  }

  function goTo({ start, end = start }) {
    hold(start, end);
    select({ start, end });
    scrollTo({ start, line: lineAndColumn(text, start).line });
  }

  // Near an end of what is held, another part follows.
  function slide() {
    const { scrollTop, scrollHeight, clientHeight } = area;
    const isNearEnd = (before && scrollTop < clientHeight) || (after && scrollHeight - scrollTop < 2 * clientHeight);
    if (!isNearEnd || scrollHeight < 4 * clientHeight) return;
    const index = Math.floor(scrollTop / lineHeight());
    holdInSight(before.length + lines.slice(0, index).reduce((sum, line) => sum + line.length + 1, 0));
  }

  // Whoever selects all that is held, as Ctrl+A does, means the whole text.
  const isAllSelected = () => !isAway() && (before || after) && area.selectionStart === 0 && area.selectionEnd === area.value.length;

  function replaceSelection(inserted) {
    const isAll = isAllSelected();
    const [head, tail] = isAll ? ["", ""] : [before + area.value.slice(0, area.selectionStart), area.value.slice(area.selectionEnd) + after];
    onReplace();
    const former = text;
    text = head + inserted + tail;
    goTo({ start: head.length + inserted.length });
    changed(former);
  }

  function changed(former, isUndone = false) {
    if (marks.length > 0) {
      moveMarks(marks, former, text);
      onMarksMoved();
    }
    repaint();
    onInput(former, isUndone);
  }

  area.addEventListener("input", ({ inputType }) => {
    const former = text;
    away = null;
    isUntouched = false;
    take(before + area.value + after);
    if (area.value.length > 2 * most_held) holdInSight(before.length + area.selectionStart);
    changed(former, inputType?.startsWith("history"));
  });
  area.addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, shiftKey } = event;
    const end = ctrlKey && !shiftKey && { Home: 0, End: text.length }[key];
    if (key.toLowerCase() === "z" && (ctrlKey || metaKey) && isUntouched) {
      event.preventDefault();
      onUndo(shiftKey);
    } else if ((before || after) && Number.isFinite(end)) {
      event.preventDefault();
      goTo({ start: end });
    } else if (concernsCaret(event)) {
      comeBack();
    }
  });
  area.addEventListener("beforeinput", ({ inputType }) => {
    if (inputType.startsWith("history")) return;
    comeBack();
    if (!isAllSelected()) return;
    onReplace();
    before = after = "";
    beforeLines = 0;
  });
  area.addEventListener("paste", (event) => {
    comeBack();
    const pasted = event.clipboardData.getData("text/plain").replaceAll("\r\n", "\n");
    if (area.value.length + pasted.length < 2 * most_held) return;
    event.preventDefault();
    replaceSelection(pasted);
  });
  for (const taking of ["copy", "cut"]) area.addEventListener(taking, (event) => {
    comeBack();
    if (!isAllSelected()) return;
    event.preventDefault();
    event.clipboardData.setData("text/plain", text);
    if (taking === "cut") replaceSelection("");
  });
  area.addEventListener("scroll", () => {
    slide();
    repaint();
  });
  area.addEventListener("mousemove", (event) => {
    const padding = parseFloat(getComputedStyle(area).paddingTop);
    const line = beforeLines + 1 + Math.floor((event.offsetY + area.scrollTop - padding) / lineHeight());
    area.title = marks.filter((mark) => mark.line === line).map((mark) => mark.message).join("\n");
  });
  document.addEventListener("selectionchange", () => {
    if (document.activeElement !== area || isAway()) return;
    away = null;
    const place = lineAndColumn(area.value, area.selectionStart);
    const line = beforeLines + place.line;
    document.querySelector("#caret").textContent = `${line}:${place.column}`;
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
      text = next.replace(/\r\n?/g, "\n");  // as a textarea has it
      marks = [];
      caretLine = 1;
      hold(0);
      select({ start: 0, end: 0 });
      area.scrollTo(0, 0);
      repaint();
    },

    /// Another state of the same document: what is in sight stays so.
    revise(next) {
      const former = text;
      text = next;
      holdInSight(before.length + area.value.length / 2);
      moveMarks(marks, former, text);
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
      scrollTo({ start, line });
      select({ start, end });
      const columnWidth = area.scrollWidth / Math.max(80, ...lines.map((each) => each.length));
      area.scrollLeft = column * columnWidth < area.clientWidth * 0.8 ? 0 : (column - 20) * columnWidth;
    },
  };
}

function linesIn(text) {
  let count = 0;
  for (let at = text.indexOf("\n"); at !== -1; at = text.indexOf("\n", at + 1)) count += 1;
  return count;
}
