// The studio's course: a scene is loaded, a hand moves the view or edits the scene, and when it rests
// the picture is refined to the accuracy chosen.
//
// data-state of the root element says where it stands: loading, moving, rendering, done or error.
import { createAccuracy } from "./accuracy.js";
import { Problem, renderFrame } from "./api.js";
import { createBoard } from "./board.js";
import { createCompare } from "./compare.js";
import { createCurvePanel } from "./curve_panel.js";
import { createEditor } from "./editor.js";
import { acceptFiles } from "./files.js";
import { createHistory, isMac } from "./history.js";
import { withElement, withoutElement, withValue } from "./json_edit.js";
import { withLines } from "./json_lines.js";
import { createLive } from "./live.js";
import { newElement } from "./new_element.js";
import { createOpening } from "./opening.js";
import { createReader, long_text } from "./outline.js";
import { showPicture } from "./picture.js";
import { showPlan } from "./plan_panel.js";
import { refine } from "./refine.js";
import { createSceneForm } from "./scene_form.js";
import { createSource } from "./scene_source.js";
import { createStatus } from "./status.js";
import { createTabs } from "./tabs.js";
import { createSharing } from "./sharing.js";
import { createProblemPanel, problemFrom } from "./problem_panel.js";
import { duration } from "./units.js";
import { sameCamera, shortView, withView } from "./view.js";
import { createViewTools } from "./view_tools.js";
import { createWaiting } from "./waiting.js";

const edited = "Edited since this picture";
const damaged_link = new Problem({
  title: "This link is damaged",
  detail: "A part of the scene in it is missing or changed. Copy the whole link, or ask for it anew; meanwhile, here is the demo.",
});
const reading_after_ms = 250;  // of a pause in typing: a long text takes a while to be read

const at = (id) => document.getElementById(id);

const status = createStatus(at("status"));
const waiting = createWaiting({ elapsed: at("elapsed"), cancel: at("cancel"), neighbour: at("board") });
const source = createSource();
const read = createReader();
let own = null;         // the document's camera; null: it has none that can be read
let lastOwn = null;     // the last one that could be read: the view is of it
let placed = [];        // the document's objects and lights
let shown = { blob: null, words: "" };  // the picture in sight
let running = null;     // the AbortController of what is under way
let reading = 0;        // the timer until typed text is read

const camera = () => ({ ...own, ...hand.view });
const view = () => own && hand.view;  // which nothing can be written into that cannot be read

const editor = createEditor(at("editor-box"), {
  onInput(former, line) {
    history.keep(former, `typing in line ${line}`);
    if (status.state === "done") status.say(edited);
    form.fallBehind();
    clearTimeout(reading);
    reading = setTimeout(takeText, reading_after_ms);
  },
  onReplace: () => history.keep(editor.text, Symbol("a replacement")),
  onUndo: (isRedo) => (isRedo ? history.redo() : history.undo()),
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
const form = createSceneForm(at("panel-form"), {
  onEdit: (pointer, value) => revise(withValue(editor.text, pointer, value), pointer),
  onAdd(list, type) {
    if (own) revise(withElement(editor.text, list, newElement(type, camera(), placed)), Symbol("one more"));
    else instead(rest);  // says what the camera lacks
  },
  onRemove: (list, index) => revise(withoutElement(editor.text, list, index), Symbol("one less")),
});
const history = createHistory({ undoer: at("undo"), redoer: at("redo") }, {
  current: () => editor.text, restore: (text) => revise(text, null),
});
const accuracy = createAccuracy(at("accuracy-box"), again);
const hand = createViewTools(at("view-tools"), at("board"), {
  onReset: again,
  async onKeep(kept) {
    if (!own) return instead(rest);  // says what is wrong with the text
    const text = withView(editor.text, shortView(kept, own));
    history.keep(editor.text, Symbol("the view"));
    editor.revise(text);
    hand.view = null;
    await takeText();
    instead(rest);
  },
});
const opening = createOpening({
  select: at("scene-select"), about: at("scene-about"), gallery: at("gallery"), opener: at("open-gallery"), restore: at("restore"),
}, {
  editor, source, accuracy, begin,
  view: () => hand.view,
  onLoading: (what) => status.enter("loading", `Loading ${what}`),
  onBring: (text) => instead((signal) => begin(text, signal, null, null)),
});
const compare = createCompare(at("board"), at("compare"), { current: () => shown });
const live = createLive(at("motion"), {
  size: camera,
  ask(settings, signal) {
    const { text } = editor;
    if (source.knows(text) || text.length >= long_text) return source.with(text, view(), settings, signal, (what) => renderFrame(what, signal));
    return renderFrame({ query: settings, body: withView(text, view()) }, signal);
  },
  onFrame(perSecond) {
    at("elapsed").textContent = `${Math.round(perSecond)} frames a second`;
  },
  onRest: () => instead(rest),
  onFail: (error) => fail(problemFrom(error)),
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

// The picture anew; where no scene has come, and none was typed, it is asked for again.
function again() {
  return instead(editor.text === "" && !opening.isBegun ? load : rest);
}

function stop() {
  running?.abort();
  live.stop();
}

// What is under way comes to nothing, in these words.
function leaveOff(words) {
  stop();
  live.hide();
  problemPanel.showDate();
  status.enter("done", words);
}

function fail(problem, text = editor.text) {
  live.hide();
  status.enter("error", problemPanel.show(problem, text));
}

// The hand rests: the picture, as accurate as was chosen.
async function rest(signal) {
  const { text } = editor;
  const words = accuracy.words;
  curve.follow();
  status.enter("rendering", "Refining");
  problemPanel.beginRender();
  // A refusal would have come early, so what was said about the text before is out of date then.
  const wait = waiting.begin(() => problemPanel.forget());
  try {
    const rendering = await refine({
      source, text, view: view(), settings: accuracy.settings, size: camera(),
      onPlan(planned) {
        accuracy.predict(planned.prediction);
        wait.expect(planned.prediction.trace_ms);
        showPlan(at("plan"), planned);
      },
      onPreview: (frame) => live.show(frame),
      onPart: (frame) => live.showPart(frame),
    }, signal);
    const total_ms = wait.passed_ms();
    await showPicture(rendering, opening.name || "scene", total_ms, signal);
    live.hide();
    accuracy.report(rendering);
    shown = { blob: rendering.blob, words };
    compare.after(words);
    problemPanel.rendered();
    status.enter("done", editor.text === text ? `${rendering.cache === "hit" ? "From the cache" : "Rendered"} in ${duration(total_ms)}` : edited);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    fail(error, text);
  } finally {
    wait.end();
    if (running?.signal === signal) waiting.clear();
  }
}

// Something moves: frames now, the picture when it rests.
function move() {
  running?.abort();
  if (status.state !== "moving") status.enter("moving", "Moving");
  waiting.hideCancel();
  live.move();
}

function look(next) {
  hand.view = { origin: next.origin, look_at: next.look_at, up: next.up };
  move();
}

// The camera follows the text; a view of another camera is none of this one.
async function takeText() {
  clearTimeout(reading);
  const { text } = editor;
  for (const id of ["share", "curl", "measure"]) at(id).disabled = text === "";
  const outline = await read(text);
  if (outline === undefined) return;  // another text has come
  own = outline && outline.camera;
  placed = outline ? [...Object.values(outline.scene.objects), ...outline.scene.lights] : [];
  if (own) {
    if (!lastOwn || !sameCamera(own, lastOwn)) hand.view = null;
    lastOwn = own;
  }
  form.show(outline);
  if (editor.text !== text) form.fallBehind();
}

// The text as the form or the hand changed it. `what` they changed, for the history; null: not for it.
async function revise(text, what) {
  if (what !== null && text !== editor.text) history.keep(editor.text, what);
  if (what === null) form.fallBehind();
  editor.revise(text);
  await takeText();
  if (own) move();
  else if (what !== null) instead(rest);
  else if (status.state !== "error") leaveOff(edited);  // as after the keys that are undone
}

async function load(signal) {
  const { areBack, isDamaged } = await opening.load(signal);
  if (status.state !== "done") return;
  if (isDamaged) status.say(problemPanel.say(damaged_link));
  if (areBack) status.say("Edits are back; Undo drops them");
}

// `former`: what Undo goes back to; null: nothing.
async function begin(text, signal, from, former) {
  problemPanel.forget();
  history.forget();
  compare.end();
  if (former !== null) history.keep(former, "load");
  form.fallBehind();
  editor.text = text;
  hand.view = null;
  await takeText();
  signal.throwIfAborted();
  hand.view = own && from;
  live.hide();
  await rest(signal);
}

createBoard(at("board"), at("tool-move"), at("board-keys"), {
  camera: () => own && camera(),
  text: () => editor.text,
  onGrab: () => history.keep(editor.text, Symbol("a drag")),
  onDrag: (text) => revise(text, null),
  onLook: look,
});
const curve = createCurvePanel(at("panel-curve"), {
  state: () => ({ text: editor.text, view: view() }),
  onSettings: (settings) => accuracy.choose(settings),
  onFail: (error) => fail(problemFrom(error)),
});
createSharing({ share: at("share"), curl: at("curl"), dialog: at("copy-dialog") }, {
  state: () => ({
    name: opening.isEdited ? "" : opening.name, title: opening.name || "scene", text: editor.text,
    view: view(), written: () => withView(editor.text, view()), choice: accuracy.choice, settings: accuracy.settings,
  }),
  moveTo: opening.moveTo, say: status.say,
});

at("with-lines").addEventListener("click", () => {
  revise(withLines(editor.text), Symbol("lines"));
  at("editor").focus();
});
at("settings").addEventListener("submit", async (event) => {
  event.preventDefault();
  await takeText();
  again();
});
document.addEventListener("keydown", (event) => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
  event.preventDefault();
  at("settings").requestSubmit();
});
acceptFiles({ gallery: at("gallery"), opener: at("open-file"), chooser: at("file") }, {
  onScene: (text, file) => instead((signal) => opening.take(text, file, signal)),
  onProblem: (error) => status.say(problemPanel.say(problemFrom(error))),
});
window.addEventListener("hashchange", () => instead(load));
at("cancel").addEventListener("click", () => leaveOff("Cancelled"));

if (isMac) at("shortcut").textContent = "⌘ ↵";
chooseTab("tab-form");
instead(load);
