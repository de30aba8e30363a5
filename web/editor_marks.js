// Marks of what is wrong in a text, {start, end, line, message} and some with a {column}, as the text
// changes.

/// An edit replaced one stretch of the text: a mark before it stays, one behind it moves along.
export function moveMarks(marks, before, after) {
  if (marks.length === 0) return;
  const shorter = Math.min(before.length, after.length);
  let start = 0;
  while (start < shorter && before[start] === after[start]) start += 1;
  const growth = after.length - before.length;
  for (const mark of marks) {
    if (mark.start >= start) mark.start = Math.max(start, mark.start + growth);
    if (mark.end >= start) mark.end = Math.max(mark.start, mark.end + growth);
  }
  let line = 1;
  let at = after.indexOf("\n");
  for (const mark of [...marks].sort((a, b) => a.start - b.start)) {
    for (; at !== -1 && at < mark.start; at = after.indexOf("\n", at + 1)) line += 1;
    mark.line = line;
    if (mark.column) mark.column = mark.start - after.lastIndexOf("\n", mark.start - 1);
  }
}
