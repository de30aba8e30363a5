// A text of which a textarea holds a part, since browsers lay out all that is in a textarea, at each
// key. Offsets and lines are the text's own, and so is what is selected: it need not be held.
import { lineAndColumn } from "./json_pointer.js";
import { longest_painted } from "./json_tokens.js";

const most_held = 40_000;  // characters that the textarea is given; it may grow to twice as many

export function createHeldText(area) {
  let text = area.value;
  let lines = [""];     // that the textarea holds
  let before = "";      // what stands before them in the text
  let after = "";       // and behind them
  let beforeLines = 0;  // the number of lines of that
  let afterLines = 0;
  let away = null;      // {start, end, shown}: of a selection in the text that is not held, and what stands for it

  const lineHeight = () => parseFloat(getComputedStyle(area).lineHeight);
  const isPart = () => before !== "" || after !== "";
  const isAway = () => away !== null && area.selectionStart === away.shown[0] && area.selectionEnd === away.shown[1];
  const selection = () => (isAway() ? away : { start: before.length + area.selectionStart, end: before.length + area.selectionEnd });

  // Whoever selects all that is held, as Ctrl+A does, means the whole text.
  const isAllSelected = () => isPart() && !isAway() && area.selectionStart === 0 && area.selectionEnd === area.value.length;

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
    afterLines = linesIn(after);
    area.value = text.slice(start, end);
    take(text);
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

  // Of what is not held, the textarea selects the nearest end.
  function select({ start, end }) {
    const shown = [start, end].map((each) => Math.max(0, Math.min(area.value.length, each - before.length)));
    area.setSelectionRange(...shown);
    const isHeld = shown[0] === start - before.length && shown[1] === end - before.length;
    away = isHeld ? null : { start, end, shown };
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

  function goTo({ start, end = start }) {
    hold(start, end);
    select({ start, end });
    scrollTo({ start, line: lineAndColumn(text, start).line });
  }

  return {
    get text() {
      return text;
    },

    /// {lines, firstLine, lineCount}: the lines that are held, the number of the first one, and how many the text has.
    get part() {
      return { lines, firstLine: beforeLines + 1, lineCount: beforeLines + lines.length + afterLines };
    },

    lineHeight, isPart, isAllSelected, select, scrollTo, goTo,

    /// Of those that are held.
    hasLongLine: () => lines.some((line) => line.length > longest_painted),

    /// Another text, from its start.
    begin(next) {
      text = next;
      hold(0);
      select({ start: 0, end: 0 });
      area.scrollTo(0, 0);
    },

    /// Another state of the text: what is in sight stays so.
    revise(next) {
      text = next;
      holdInSight(before.length + area.value.length / 2);
    },

    /// After another state of the text `former`: the caret is behind what differs, in sight.
    showChange(former) {
      if (former === text) return;
      const shorter = Math.min(former.length, text.length);
      let start = 0;
      while (start < shorter && former[start] === text[start]) start += 1;
      let same = 0;
      while (same < shorter - start && former[former.length - 1 - same] === text[text.length - 1 - same]) same += 1;
      const end = text.length - same;
      const isHeld = end >= before.length && end <= text.length - after.length;
      if (isHeld && this.isInSight(lineAndColumn(text, end))) select({ start: end, end });
      else goTo({ start: end });
    },

    /// After a change by the person in the textarea.
    readTyped() {
      away = null;
      take(before + area.value + after);
      if (area.value.length > 2 * most_held) holdInSight(before.length + area.selectionStart);
    },

    /// What is typed next replaces the whole text.
    letGoOfRest() {
      before = after = "";
      beforeLines = afterLines = 0;
    },

    hasRoomFor: (inserted) => area.value.length + inserted.length < 2 * most_held,

    /// What the textarea has no room for.
    replaceSelection(inserted) {
      const [head, tail] = isAllSelected() ? ["", ""] : [before + area.value.slice(0, area.selectionStart), area.value.slice(area.selectionEnd) + after];
      text = head + inserted + tail;
      goTo({ start: head.length + inserted.length });
    },

    /// To where the selection is, however far the text has been scrolled since.
    comeBack() {
      if (isAway()) goTo(away);
    },

    /// {line, column} to which the person moved the caret; null while the selection is not held.
    caret() {
      if (isAway()) return null;
      away = null;
      const { line, column } = lineAndColumn(area.value, area.selectionStart);
      return { line: beforeLines + line, column };
    },

    isInSight({ line }) {
      const top = (line - 1 - beforeLines) * lineHeight() - area.scrollTop;
      return top >= 0 && top < area.clientHeight - lineHeight();
    },

    /// The line that is seen `offset_px` below the textarea's top edge.
    lineAt(offset_px) {
      const padding = parseFloat(getComputedStyle(area).paddingTop);
      return beforeLines + 1 + Math.floor((offset_px + area.scrollTop - padding) / lineHeight());
    },

    /// Near an end of what is held, another part follows.
    slide() {
      const { scrollTop, scrollHeight, clientHeight } = area;
      const isNearEnd = (before && scrollTop < clientHeight) || (after && scrollHeight - scrollTop < 2 * clientHeight);
      if (!isNearEnd || scrollHeight < 4 * clientHeight) return;
      const index = Math.floor(scrollTop / lineHeight());
      holdInSight(before.length + lines.slice(0, index).reduce((sum, line) => sum + line.length + 1, 0));
    },
  };
}

function linesIn(text) {
  let count = 0;
  for (let at = text.indexOf("\n"); at !== -1; at = text.indexOf("\n", at + 1)) count += 1;
  return count;
}
