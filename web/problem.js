// What is wrong, in words: the problem, and its errors as a list that leads to their places.
import { element } from "./element.js";
import { lineAndColumn, locator, offsetOf } from "./json_pointer.js";
import { pluralised } from "./units.js";

const most_listed = 200;  // errors; nobody reads further, and each is a mark in the editor

/// The errors of a Problem as marks in `text`, the document that it is about:
/// [{start, end, line, message, pointer}], with a {column} where the text is no JSON, in the order of the text. `overriding`: the controls
/// that stood over the document, by pointer; an error of theirs gets {control} and no place.
export function marksOf(problem, text, overriding) {
  const syntax = syntaxMark(problem.errors[0], text);
  if (syntax) return [syntax];
  const place = locator(text);
  const marks = problem.errors.slice(0, most_listed).map(({ pointer, detail, about }) => {
    const control = overriding.get(pointer);
    if (control) return { control, pointer, message: detail };
    const { key, value } = place(pointer);
    const { start, end } = key && about === "key" ? key : value;
    return { start, end, pointer, message: detail, line: lineAndColumn(text, start).line };
  });
  return marks.sort((a, b) => rank(a) - rank(b));
}

// Text that is not JSON has no pointers: its one error says where it stops being JSON.
function syntaxMark(error, text) {
  if (!error?.line) return null;
  const start = offsetOf(text, error.line, error.column);
  return { start, end: start, pointer: "", message: error.reason, ...lineAndColumn(text, start) };
}

// The controls stand above the text; what is said of the whole document comes last.
function rank({ control, pointer, start }) {
  if (control) return -1;
  return pointer === "" ? Infinity : start;
}

/// Shows the problem with its marks; `reveal(mark)` follows a click on one.
export function showProblem(problem, marks, reveal) {
  const says = marks.length > 0 ? [] : [problem.detail];
  if (problem.errors.length > marks.length && marks.length > 0) says.push(`The first ${marks.length} are listed.`);
  if (problem.retryAfter) says.push(`The server suggests another attempt in ${problem.retryAfter} s.`);
  document.querySelector("#problem-summary").replaceChildren(
    element("strong", {}, titleOf(problem, marks)), ...says.flatMap((sentence) => [" ", sentence]));
  document.querySelector("#errors").replaceChildren(...marks.map((mark) => row(mark, reveal)));
  document.querySelector("#problem").hidden = false;
}

// Where there are marks they say all that the detail does, and HTTP's phrase would explain nothing.
function titleOf({ status, title, errors }, marks) {
  if (marks.length === 0) return title;
  if (status === 400) return "The text is not JSON";
  if (status === 413) return "More than this server accepts";
  return `${pluralised(errors.length, "error")} in the scene`;
}

export function hideProblem() {
  document.querySelector("#problem").hidden = true;
  document.querySelector("#problem-summary").replaceChildren();
  document.querySelector("#errors").replaceChildren();
}

/// After an edit: the marks' lines may have changed.
export function renumber(marks) {
  const rows = document.querySelector("#errors").children;
  marks.forEach((mark, index) => {
    if (mark.control) return;
    rows[index].dataset.line = mark.line;
    rows[index].querySelector(".line").textContent = placeOf(mark);
  });
}

function row(mark, reveal) {
  const place = mark.control
    ? [piece("line", "↑"), piece("unseen", mark.control.labels[0].textContent)]
    : [piece("unseen", "Line"), piece("line", placeOf(mark))];
  const rest = [piece("message", mark.message), piece("pointer", mark.pointer)];
  // The spaces part the words for those who hear them; the layout ignores them.
  const button = element("button", { type: "button" }, ...[...place, ...rest].flatMap((each) => [each, " "]));
  button.addEventListener("click", () => reveal(mark));
  const item = element("li", {}, button);
  if (!mark.control) item.dataset.line = mark.line;
  return item;
}

// As the caret's is said.
const placeOf = ({ line, column }) => (column ? `${line}:${column}` : line);

const piece = (className, text) => element("span", { className }, text);
