// The scene's own speed-accuracy curve: measured by the server as a job, drawn, and each of its
// points a picture with its difference from the reference.
import { jobResult, renderFrame } from "./api.js";
import { errorText, settingsText } from "./accuracy.js";
import { curvePlot } from "./curve_plot.js";
import { differenceOf } from "./difference.js";
import { element } from "./element.js";
import { withJob } from "./job.js";
import { withValue } from "./json_edit.js";
import { duration } from "./units.js";
import { withView } from "./view.js";

const gain = 16;  // of the difference

/// `box` holds #measure, #curve-progress, #curve-says, #curve-plot and #curve-figures.
/// `state()` gives {text, view}; `onSettings(settings)` follows the choice of a point that a
/// query can ask for, and resolves when it is in sight; `onFail(error)` follows a failure. Returns
/// follow(), to be told when the state may be another than was measured.
export function createCurvePanel(box, { state, onSettings, onFail }) {
  const [measure, progress, says, plot, figures] =
    ["measure", "curve-progress", "curve-says", "curve-plot", "curve-figures"].map((id) => box.querySelector(`#${id}`));
  let running = null;   // the AbortController of the job
  let choosing = null;  // and of the point's pictures
  let measured = null;  // {state, words}: what the plot is about, and what is said of it

  const isSame = (a, b) => a.text === b.text && JSON.stringify(a.view) === JSON.stringify(b.view);

  // A curve says nothing of another scene or view; it waits for its own to come back.
  function follow() {
    if (!measured) return;
    const isCurrent = isSame(measured.state, state());
    plot.inert = !isCurrent;
    if (!isCurrent) {
      choosing?.abort();
      figures.replaceChildren();
    }
    if (!running) says.textContent = isCurrent ? measured.words : "This was measured for another scene or view. Measure again for this one.";
  }

  async function run(signal) {
    const begun = state();
    const written = withView(begun.text, begun.view);
    says.textContent = "Measuring: the same picture with many settings, against a reference.";
    const onProgress = (job) => {
      progress.value = job.progress;
    };
    const curve = await withJob("tradeoff", { query: {}, body: written }, signal, onProgress, (id) => jobResult(id, signal));
    measured = { state: begun, words: wordsOf(curve) };
    show(written, curve);
  }

  function show(text, curve) {
    plot.replaceChildren(curvePlot(curve.points, { nameOf, onChoose: (point) => choose(text, curve, point) }));
    figures.replaceChildren();
  }

  // The picture first, alone. The reference takes a hundred times as long, and is rendered once.
  async function choose(text, curve, point) {
    follow();
    if (plot.inert) return;
    const { shadows, ...settings } = point.settings;
    choosing?.abort();
    choosing = new AbortController();
    const { signal } = choosing;
    const size = { width: curve.width, height: curve.height };
    const frame = (query, body) => renderFrame({ query: { ...query, ...size }, body }, signal);
    const about = element("p", {}, `${nameOf(point)}. Largest error ${errorText(point.max_error)}.`);
    const more = element("p", { className: "reason" }, "Rendering the reference, for the difference from it…");
    try {
      figures.replaceChildren(about);
      if (!shadows) await onSettings(settings);
      signal.throwIfAborted();
      const picture = await frame(settings, shadows ? withValue(text, "/shadows", shadows) : text);
      // What a query can ask for is in the large picture already.
      figures.replaceChildren(about, ...(shadows ? [figure(picture, "The picture")] : []), more);
      curve.image ??= await frame({ ...curve.reference.settings, samples: curve.reference.samples }, text);
      more.replaceWith(figure(differenceOf(picture, curve.image, gain), `Its difference from the reference, ${gain} times enlarged; grey is none`));
    } catch (error) {
      if (!signal.aborted) onFail(error);
    }
  }

  measure.addEventListener("click", async () => {
    if (running) return running.abort();
    const mine = new AbortController();
    running = mine;
    measure.textContent = "Stop measuring";
    progress.hidden = false;
    progress.value = 0;
    try {
      await run(mine.signal);
      running = null;
      follow();
    } catch (error) {
      says.textContent = mine.signal.aborted ? "Stopped." : "Not measured.";
      if (!mine.signal.aborted) onFail(error);
    } finally {
      running = null;
      progress.hidden = true;
      measure.textContent = "Measure the curve";
    }
  });

  return { follow };
}

function wordsOf({ points, width, height, reference }) {
  return `${points.length} settings at ${width} × ${height}, against ${reference.samples} samples per pixel. `
    + "The line joins those that nothing beats; rings leave something out. Choose a point to see its picture.";
}

function nameOf({ settings, trace_ms, rmse }) {
  return `${settingsText(settings)}: ${duration(trace_ms)}, error ${errorText(rmse)}`;
}

function figure(image, words) {
  const canvas = element("canvas", { width: image.width, height: image.height, role: "img", ariaLabel: words });
  canvas.getContext("2d").putImageData(image, 0, 0);
  return element("figure", {}, canvas, element("figcaption", {}, words));
}
