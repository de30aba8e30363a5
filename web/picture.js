// The picture, and what is known about how it came to be.
import { element } from "./element.js";
import { bytes, digits, duration, pluralised } from "./units.js";

const origins = { hit: "from the server's cache", shared: "rendered for another request too" };
const stops = { samples: "sample count", target: "accuracy target", budget: "time budget" };

/// Shows what api.js's render() gave. `name` is the scene's, for the file and for screen readers;
/// `total_ms` is the time from the request to the picture, as this page saw it. Once `signal` is
/// aborted nothing is shown.
export async function showPicture(rendering, name, total_ms, signal) {
  const image = document.querySelector("#picture");
  const download = document.querySelector("#download");
  const board = document.querySelector("#board");
  const address = URL.createObjectURL(rendering.blob);

  // Decoded before it is shown: the former picture stays until then, without a blink.
  const decoded = new Image();
  decoded.src = address;
  try {
    await decoded.decode();
    signal.throwIfAborted();
  } catch (error) {
    URL.revokeObjectURL(address);
    throw error;
  }
  const former = image.src;
  image.src = address;
  image.width = decoded.naturalWidth;
  image.height = decoded.naturalHeight;
  board.style.setProperty("--ratio", decoded.naturalWidth / decoded.naturalHeight);
  board.style.setProperty("--width-px", decoded.naturalWidth);
  board.hidden = false;
  image.alt = `Rendered picture of the scene ${name}`;
  image.hidden = false;
  if (former) URL.revokeObjectURL(former);

  download.href = address;
  download.download = `${name}.png`;
  download.hidden = false;

  showFacts(rendering, `${decoded.naturalWidth} × ${decoded.naturalHeight}`);
  // What was not done for this answer took no time in it, and is nothing to show.
  showStages(rendering.stages.filter(({ ms }) => !rendering.cache || ms > 0), total_ms);
}

function showFacts({ blob, cache, samples, precision, error, stop, tasks, workers }, size) {
  const facts = [
    ["Size", size],
    ["Samples per pixel", samples && digits(Number(samples))],
    ["Precision", precision],
    ["Estimated error", error],
    ["Ended by", stop && (stops[stop] ?? stop)],
    ["Rendered as", tasks && `${pluralised(Number(tasks), "task")} by ${pluralised(Number(workers), "worker")}`],
    ["PNG", bytes(blob.size)],
    ["Came", origins[cache]],
  ];
  const rows = facts.filter(([, value]) => value)
    .map(([term, value]) => element("div", {}, element("dt", {}, term), element("dd", {}, value)));
  document.querySelector("#facts").replaceChildren(...rows);
}

// A bar whose parts are the server's stages, and below it each with its name and time.
function showStages(stages, total_ms) {
  const timings = document.querySelector("#timings");
  const known_ms = stages.reduce((sum, stage) => sum + stage.ms, 0);
  // What the server does not account for is the way there and back, and the browser's own work.
  const parts = [...stages, { name: "transport", ms: Math.max(0, total_ms - known_ms) }];
  const bar = element("div", { className: "bar" });
  const legend = element("ul");
  for (const { name, ms } of parts) {
    const part = element("span");
    part.dataset.stage = name;
    part.style.flexGrow = ms;
    bar.append(part);
    const row = timed(name, ms);
    row.dataset.stage = name;
    legend.append(row);
  }
  legend.append(timed("total", total_ms));
  bar.setAttribute("aria-hidden", "true");
  timings.replaceChildren(bar, legend);
  timings.hidden = false;
}

function timed(name, ms) {
  return element("li", {}, `${name} `, element("span", {}, duration(ms)));
}
