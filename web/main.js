// The studio's course: a scene is loaded, a hand moves the view or edits the scene, and when it rests
// the picture is refined to the accuracy chosen.
//
// data-state of the root element says where it stands: loading, moving, rendering, done or error.
import { createAccuracy } from "./accuracy.js";
import { Problem, renderFrame, sceneText } from "./api.js";
import { createAside } from "./aside.js";
import { createBoard } from "./board.js";
import { createCompare } from "./compare.js";
import { createCurvePanel } from "./curve_panel.js";
import { acceptDrops } from "./drop.js";
import { createEditor } from "./editor.js";
import { createHistory } from "./history.js";
import { withElement, withoutElement, withValue } from "./json_edit.js";
import { createLive } from "./live.js";
import { newElement } from "./move_sphere.js";
import { createReader, long_text } from "./outline.js";
import { showPicture } from "./picture.js";
import { showPlan } from "./plan_panel.js";
import { refine } from "./refine.js";
import { createSceneForm } from "./scene_form.js";
import { createSceneList } from "./scene_list.js";
import { createSource } from "./scene_source.js";
import { fragmentOf, readFragment } from "./share.js";
import { createTabs } from "./tabs.js";
import { createSharing } from "./sharing.js";
import { createProblemPanel, problemFrom } from "./problem_panel.js";
import { duration } from "./units.js";
import { keepEdits } from "./unsaved.js";
import { sameCamera, withView } from "./view.js";
import { startWaiting } from "./waiting.js";

const first_scene = "demo";
const edited = "Edited since this picture";
const damaged_link = new Problem({
  title: "This link is damaged",
  detail: "A part of the scene in it is missing or changed. Copy the whole link, or ask for it anew; meanwhile, here is the demo.",
});
const reading_after_ms = 250;  // of a pause in typing: a long text takes a while to be read

const root = document.documentElement;
const at = (id) => document.getElementById(id);
const [status, elapsed, cancel] = ["status", "elapsed", "cancel"].map(at);

const source = createSource();
const read = createReader();
let loaded = { name: first_scene, text: "" };  // what the text began as; name "": it came in a link or a file
let isBegun = false;    // there is a text to render
let own = null;         // the document's camera; null: it has none that can be read
let view = null;        // {origin, look_at, up} as the hand left them; null: the document's own
let shown = { blob: null, words: "" };  // the picture in sight
let left = keepEdits(() => left ?? edits());  // what is to be brought back
let said = "";          // of the state
let running = null;     // the AbortController of what is under way
let reading = 0;        // the timer until typed text is read
let isFormBehind = false;  // the text has changed since: the form's places are not those of its values

const camera = () => ({ ...own, ...view });

const editor = createEditor(at("editor-box"), {
  onInput(former, isUndone) {
    if (!isUndone) history.keep(former, "typing");
    if (root.dataset.state === "done") status.textContent = edited;
    isFormBehind = true;
    clearTimeout(reading);
    reading = setTimeout(takeText, reading_after_ms);
  },
  onReplace: () => history.keep(editor.text, Symbol("a replacement")),
  onUndo: () => history.undo(),
  onMarksMoved: () => problemPanel.renumber(),
});
const problemPanel = createProblemPanel({
  editor, dated: at("dated"),
  overriding: () => new Map(Object.keys(accuracy.settings).map((key) => [`/render/${key}`, accuracy.slider])),
  reveal(mark) {
    chooseTab("tab-json");
    editor.reveal(mark);
  },
});
const chooseTab = createTabs(at("tabs"));
const form = createSceneForm(at("form"), {
  onEdit: (pointer, value) => reviseByForm((text) => withValue(text, pointer, value), pointer),
  onAdd(list, type) {
    if (own) reviseByForm((text) => withElement(text, list, newElement(type, camera())), "add");
    else instead(rest);  // says what the camera lacks
  },
  onRemove: (list, index) => reviseByForm((text) => withoutElement(text, list, index), "remove"),
});
const scenes = createSceneList(
  { select: at("scene-select"), about: at("scene-about"), gallery: at("gallery"), opener: at("open-gallery") },
  { current: () => loaded.name, onChoose: open });
const aside = createAside(at("restore"), {
  current: unsaved,
  async onBring(edit) {
    const fragment = await fragmentOf({ ...edit.loaded, view: null, choice: accuracy.choice });
    loaded = edit.loaded;
    scenes.choose(loaded.name);
    window.history.replaceState(null, "", fragment);
    instead((signal) => begin(edit.text, signal));
  },
});
const history = createHistory(at("undo"), { current: () => editor.text, restore: (text) => revise(text, null) });
const accuracy = createAccuracy(at("accuracy-box"), () => instead(rest));
const compare = createCompare(at("board"), at("compare"), { current: () => shown });
const live = createLive(at("motion"), {
  size: camera,
  ask(settings, signal) {
    const { text } = editor;
    if (source.knows(text) || text.length >= long_text) return source.with(text, view, settings, signal, (what) => renderFrame(what, signal));
    return renderFrame({ query: settings, body: withView(text, view) }, signal);
  },
  onFrame(perSecond) {
    elapsed.textContent = `${Math.round(perSecond)} frames a second`;
  },
  onRest: () => instead(rest),
  onFail: (error) => fail(problemFrom(error)),
});

function enter(state, words) {
  root.dataset.state = state;
  status.textContent = said = words;
}

document.addEventListener("busy", ({ detail: seconds }) => {
  status.textContent = seconds > 0 ? `The server is busy: again in ${seconds} s` : said;
});

// Does `work(signal)` in place of what is under way. Its failure is shown; being replaced is none.
async function instead(work) {
  stop();
  const mine = new AbortController();
  running = mine;
  try {
    await work(mine.signal);
  } catch (error) {
    if (!mine.signal.aborted) fail(problemFrom(error));
  } finally {
    if (running === mine) running = null;
  }
}

function stop() {
  running?.abort();
  live.stop();
}

function fail(problem, text = editor.text) {
  live.hide();
  enter("error", problemPanel.show(problem, text));
}

// The hand rests: the picture, as accurate as was chosen.
async function rest(signal) {
  const { text } = editor;
  const words = accuracy.words;
  curve.follow();
  enter("rendering", "Refining");
  problemPanel.beginRender();
  // A refusal would have come early, so what was said about the text before is out of date then.
  const waiting = startWaiting(elapsed, cancel, () => problemPanel.forget());
  try {
    const rendering = await refine({
      source, text, view, settings: accuracy.settings, size: camera(),
      onPlan(foreseen) {
        accuracy.foresee(foreseen.prediction);
        waiting.expect(foreseen.prediction.trace_ms);
        showPlan(at("plan"), foreseen);
      },
      onPreview: (frame) => live.show(frame),
      onPart: (frame) => live.showPart(frame),
    }, signal);
    const total_ms = waiting.passed_ms();
    await showPicture(rendering, loaded.name || "scene", total_ms);
    signal.throwIfAborted();
    live.hide();
    accuracy.report(rendering);
    shown = { blob: rendering.blob, words };
    compare.after(words);
    problemPanel.rendered();
    enter("done", editor.text === text ? `${rendering.cache === "hit" ? "From the cache" : "Rendered"} in ${duration(total_ms)}` : edited);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    fail(error, text);
  } finally {
    waiting.end();
    if (running.signal === signal) {
      elapsed.textContent = "";
      cancel.hidden = true;
    }
  }
}

// Something moves: frames now, the picture when it rests.
function move() {
  running?.abort();
  if (root.dataset.state !== "moving") enter("moving", "Moving");
  cancel.hidden = true;
  live.move();
}

function look(next) {
  view = { origin: next.origin, look_at: next.look_at, up: next.up };
  at("view-tools").hidden = false;
  move();
}

// The camera follows the text; a view of another camera is none of this one.
async function takeText() {
  clearTimeout(reading);
  const outline = await read(editor.text);
  if (outline === undefined) return;  // another text has come
  const former = own;
  own = outline && outline.camera;
  if (!own || !former || !sameCamera(own, former)) view = null;
  at("view-tools").hidden = view === null;
  showForm(outline);
}

// What the form cannot show it does not edit either; the picture is none of its business.
function showForm(outline) {
  let why = outline ? "" : "The text is no scene now, and nothing here can change it. Render says what is wrong.";
  try {
    if (outline) form.show(outline.scene);
  } catch (error) {
    why = `This form cannot show the scene: ${error.message}.`;
  }
  at("form-rests").textContent = why;
  at("form-rests").hidden = why === "";
  at("form").inert = why !== "";
  isFormBehind = false;
}

// The text as the form or the hand changed it. `what` they changed, for the history; null: not for it.
async function revise(text, what) {
  if (what !== null) history.keep(editor.text, what);
  editor.revise(text);
  await takeText();
  if (own) move();
  else instead(rest);
}

function reviseByForm(change, what) {
  if (isFormBehind) return;
  const text = change(editor.text);
  if (text === editor.text) return;
  isFormBehind = what === "remove";
  revise(text, what);
}

async function load(signal) {
  await scenes.load();
  signal.throwIfAborted();
  const asked = await readFragment(location.hash || location.search);  // /?scene=glass, typed by hand, counts too
  const back = left?.hash === location.hash ? left : null;
  const isOwn = asked.text !== null || Boolean(back?.text && back.name === "");  // from a link, or a file that was dropped here
  const name = isOwn ? "" : asked.name ?? first_scene;
  enter("loading", `Loading ${name || "your scene"}`);
  scenes.choose(name);
  const text = asked.text ?? (isOwn ? "" : await sceneText(name, signal));
  layAside(back !== null);
  loaded = { name, text };
  if (name) source.know(name, text);
  if (Object.keys(asked.choice).length > 0) accuracy.choice = asked.choice;
  const isEdited = Boolean(text && back?.text && back.text !== text);
  await begin(back?.text ?? text, signal, back ? back.view : asked.view, isEdited ? text : null);
  if (root.dataset.state !== "done") return;
  if (asked.isDamaged) status.textContent = problemPanel.say(damaged_link);
  if (isEdited) status.textContent = "Edits are back; Undo drops them";
}

// A dropped file, whose text no address has: for the tab it is an edit, which it keeps.
async function take(text, file, signal) {
  enter("loading", `Loading ${file}`);
  layAside(false);
  loaded = { name: "", text: "" };
  if (location.hash) window.history.pushState(null, "", location.pathname + location.search);  // Back leads to the scene before
  scenes.choose("");
  await begin(text, signal);
}

function unsaved() {
  return editor.text === loaded.text ? null : { loaded, text: editor.text };
}

// Another scene comes; it may go on with what the page left when it was last here.
function layAside(goesOn) {
  const edit = unsaved();
  if (edit) aside.add(edit);
  if (!left) return;
  const { name, text, aside: others } = left;
  aside.add(...[others ?? []].flat());
  if (text !== null && !goesOn) aside.add({ loaded: { name, text: "" }, text });
  left = null;
}

function edits() {
  const text = unsaved()?.text ?? null;
  if (text === null && view === null && aside.edits.length === 0) return null;
  return { hash: location.hash, name: loaded.name, text, view, aside: aside.edits };
}

// `former`: what Undo goes back to, if anything.
async function begin(text, signal, from = null, former = null) {
  isBegun = true;
  problemPanel.forget();
  history.forget();
  if (former !== null) history.keep(former, "load");
  editor.text = text;
  view = null;
  await takeText();
  signal.throwIfAborted();
  view = own && from;
  at("view-tools").hidden = view === null;
  live.hide();
  await rest(signal);
}

function open(name) {
  location.hash = new URLSearchParams({ scene: name });
}

createBoard(at("board"), at("tool-move"), {
  camera: () => own && camera(),
  text: () => editor.text,
  onGrab: () => history.keep(editor.text, Symbol("a drag")),
  onDrag: (text) => revise(text, null),
  onLook: look,
});
at("keep-view").addEventListener("click", async () => {
  const text = withView(editor.text, view);
  history.keep(editor.text, "view");
  editor.revise(text);
  await takeText();
  instead(rest);
});
at("reset-view").addEventListener("click", () => {
  view = null;
  at("view-tools").hidden = true;
  instead(rest);
});
const curve = createCurvePanel(at("panel-curve"), {
  state: () => ({ text: editor.text, view }),
  onSettings: (settings) => accuracy.choose(settings),
  onFail: (error) => fail(problemFrom(error)),
});
createSharing({ share: at("share"), curl: at("curl"), dialog: at("copy-dialog") }, () => ({
  name: editor.text === loaded.text ? loaded.name : "", title: loaded.name || "scene", text: editor.text, view,
  written: () => withView(editor.text, view), choice: accuracy.choice, settings: accuracy.settings,
}), (words) => {
  status.textContent = words;
});

at("settings").addEventListener("submit", async (event) => {
  event.preventDefault();
  await takeText();
  instead(isBegun ? rest : load);  // where no scene has come, it is asked for again
});
document.addEventListener("keydown", (event) => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
  event.preventDefault();
  at("settings").requestSubmit();
});
acceptDrops({
  onScene: (text, file) => instead((signal) => take(text, file, signal)),
  onProblem: (error) => {
    status.textContent = problemPanel.say(problemFrom(error));
  },
});
window.addEventListener("hashchange", () => instead(load));
cancel.addEventListener("click", () => {
  stop();
  live.hide();
  problemPanel.showDate();
  enter("done", "Cancelled");
});

if (/Mac|iPhone|iPad/.test(navigator.platform)) at("shortcut").textContent = "⌘ ↵";
chooseTab("tab-form");
instead(load);
