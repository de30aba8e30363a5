// The page's course: a scene is loaded, its text is rendered, the picture or the problem is shown.
//
// data-state of the root element says where it stands: loading, rendering, done or error.
import { listScenes, Problem, render, sceneText } from "./api.js";
import { createEditor } from "./editor.js";
import { showPicture } from "./picture.js";
import { hideProblem, marksOf, renumber, showProblem } from "./problem.js";
import { counted, duration } from "./units.js";

const first_scene = "demo";
const patience_ms = 200;  // shorter renders need no sign of life
const edited = "Edited since this picture";

const root = document.documentElement;
const [status, elapsed, cancel, dated, restore, sceneSelect, about, form, samples, transfer] = [
  "status", "elapsed", "cancel", "dated", "restore", "scene-select", "scene-about", "settings",
  "samples", "transfer",
].map((id) => document.getElementById(id));

let loaded = { name: first_scene, text: "" };  // the shipped scene that the text began as
let laidAside = null;   // {loaded, text}: edits that another scene has replaced
let renderedAt = null;  // when the picture in sight was rendered
let marks = [];         // what is marked in the editor and listed below it
let running = null;     // the AbortController of what is under way

const editor = createEditor(document.getElementById("editor-box"), {
  onInput() {
    if (root.dataset.state === "done") status.textContent = edited;
  },
  onMarksMoved() {
    renumber(marks);
  },
});

function enter(state, words) {
  root.dataset.state = state;
  status.textContent = words;
}

// Does `work(signal)` in place of what is under way. Its failure is shown; being replaced is none.
async function instead(work) {
  running?.abort();
  const mine = new AbortController();
  running = mine;
  try {
    await work(mine.signal);
  } catch (error) {
    if (mine.signal.aborted) return;
    fail(error instanceof Problem ? error : new Problem({ title: "This page failed", detail: String(error) }));
  } finally {
    if (running === mine) running = null;
  }
}

function fail(problem, text = editor.text) {
  const overriding = new Map([["/render/samples", samples], ["/render/transfer", transfer]]
    .filter(([, control]) => control.value !== ""));
  marks = marksOf(problem, text, overriding);
  showProblem(problem, marks, (mark) => (mark.control ? mark.control.focus() : editor.reveal(mark)));
  editor.mark(marks.filter((mark) => !mark.control), text);
  document.getElementById("problem").scrollIntoView({ block: "nearest" });
  dated.hidden = renderedAt === null;
  const what = marks.length > 0 ? "Picture of the last valid scene" : "Picture of the last render";
  dated.textContent = `${what}, ${renderedAt?.toLocaleTimeString()}`;
  enter("error", marks.length > 0 ? `Not rendered: ${counted(Math.max(marks.length, problem.errors.length), "error")}` : "Not rendered");
}

function forgetProblem() {
  marks = [];
  editor.mark(marks, editor.text);
  hideProblem();
}

async function renderText(signal) {
  const { text } = editor;
  const started_ms = performance.now();
  elapsed.textContent = "";
  cancel.hidden = true;
  enter("rendering", "Rendering");
  const clock = setInterval(() => {
    const passed_ms = performance.now() - started_ms;
    if (passed_ms < patience_ms) return;
    // A refusal would have come by now, so what was said about the text before is out of date.
    if (marks.length > 0) forgetProblem();
    elapsed.textContent = `${(passed_ms / 1000).toFixed(1)} s`;
    cancel.hidden = false;
  }, 100);
  try {
    const rendering = await render(text, { samples: samples.value, transfer: transfer.value }, signal);
    const total_ms = performance.now() - started_ms;
    await showPicture(rendering, loaded.name, total_ms);
    signal.throwIfAborted();
    renderedAt = new Date();
    dated.hidden = true;
    forgetProblem();
    document.getElementById("picture").scrollIntoView({ block: "nearest" });
    enter("done", editor.text === text ? `Rendered in ${duration(total_ms)}` : edited);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    fail(error, text);
  } finally {
    clearInterval(clock);
    if (running.signal === signal) {
      elapsed.textContent = "";
      cancel.hidden = true;
    }
  }
}

async function loadScene(signal) {
  const name = new URLSearchParams(location.hash.slice(1)).get("scene") ?? first_scene;
  enter("loading", `Loading ${name}`);
  choose(name);
  const text = await sceneText(name, signal);
  laidAside = editor.text === loaded.text ? null : { loaded, text: editor.text };
  loaded = { name, text };
  await begin(text, signal);
}

async function begin(text, signal) {
  restore.hidden = laidAside === null;
  forgetProblem();
  editor.text = text;
  await renderText(signal);
}

function choose(name) {
  sceneSelect.value = name;
  about.textContent = sceneSelect.selectedOptions[0]?.dataset.description ?? "";
}

async function start(signal) {
  const scenes = await listScenes();
  sceneSelect.replaceChildren(...scenes.map(({ name, title, description }) => {
    const option = new Option(title, name);
    option.dataset.description = description;
    return option;
  }));
  if (signal.aborted) choose(loaded.name);
  else await loadScene(signal);
}

form.addEventListener("submit", (event) => {
  event.preventDefault();
  instead(renderText);
});
document.addEventListener("keydown", (event) => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
  event.preventDefault();
  form.requestSubmit();
});
sceneSelect.addEventListener("change", () => {
  location.hash = new URLSearchParams({ scene: sceneSelect.value });
});
window.addEventListener("hashchange", () => instead(loadScene));
cancel.addEventListener("click", () => {
  running?.abort();
  enter("done", "Cancelled");
});
restore.addEventListener("click", () => {
  const { text } = laidAside;
  loaded = laidAside.loaded;
  laidAside = null;
  choose(loaded.name);
  history.replaceState(null, "", `#${new URLSearchParams({ scene: loaded.name })}`);
  instead((signal) => begin(text, signal));
});

if (/Mac|iPhone|iPad/.test(navigator.platform)) document.getElementById("shortcut").textContent = "⌘ ↵";
instead(start);
