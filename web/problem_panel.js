// What is wrong, at all its places at once: the list below the scene, the marks in the editor, and
// the word beside the picture that it is an older one.
import { hideProblem, marksOf, renumber, showProblem } from "./problem.js";
import { Problem } from "./api.js";
import { pluralised } from "./units.js";

/// `dated` is the picture's caption. `overriding()` gives the controls that stand over the document,
/// by pointer; `reveal(mark)` follows a click on an error that has a place in the text.
export function createProblemPanel({ editor, dated, overriding, reveal }) {
  let marks = [];         // what is marked in the editor and listed below it
  let renderedAt = null;  // when the picture in sight was
  let isSaid = false;     // since the last render began, and so not about it

  function showDate(what = "Picture of the last render") {
    dated.hidden = renderedAt === null;
    dated.textContent = `${what}, ${renderedAt?.toLocaleTimeString()}`;
  }

  return {
    /// Says that the picture in sight is an older one.
    showDate: () => showDate(),

    /// `text` is the document that the problem is about. Returns what to say of it in two or three words.
    show(problem, text) {
      marks = marksOf(problem, text, overriding());
      showProblem(problem, marks, (mark) => (mark.control ? mark.control.focus() : reveal(mark)));
      editor.mark(marks.filter((mark) => !mark.control), text);
      document.getElementById("problem").scrollIntoView({ block: "nearest" });
      showDate(marks.length > 0 ? "Picture of the last valid scene" : undefined);
      return marks.length > 0 ? `Not rendered: ${pluralised(Math.max(marks.length, problem.errors.length), "error")}` : "Not rendered";
    },

    /// Says what is wrong with neither the text nor the picture. Returns it in short.
    say(problem) {
      isSaid = true;
      showProblem(problem, []);
      return problem.message;
    },

    /// After an edit: the marks' lines may have changed.
    renumber() {
      renumber(marks);
    },

    /// What was said is out of date.
    forget() {
      marks = [];
      editor.mark(marks, editor.text);
      hideProblem();
    },

    /// What was said until now is out of date when this render has a picture.
    beginRender() {
      isSaid = false;
    },

    /// A picture without a problem is in sight, from now.
    rendered() {
      renderedAt = new Date();
      dated.hidden = true;
      if (!isSaid) this.forget();
    },
  };
}

/// Any failure as a Problem.
export function problemFrom(error) {
  return error instanceof Problem ? error : new Problem({ title: "This page failed", detail: String(error) });
}
