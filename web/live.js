// The picture while something moves: small promises kept often. One request is under way at a time,
// each for the newest state, within a time budget; frames that come late are drawn smaller.
import { frameSize } from "./frame.js";

const budget_ms = 8;       // of tracing, for each frame
const late_ms = 42;        // slower than this, and the next frames are smaller: 20 a second need 50 ms
const early_ms = 22;       // faster than this, and they may grow again
const scales = [1, 0.75, 0.55, 0.4, 0.28, 0.2];
const rest_ms = 160;       // without a movement, the hand rests
const black = 0xff000000;  // as a word of ImageData
const lasting = 0.7;       // of the mean latency, at each frame

/// `canvas` lies over the picture. `ask(settings, signal)` gives a frame of the state of that moment
/// as ImageData; `size()` is the picture's {width, height}; `onRest()` follows the last
/// movement; `onFrame(perSecond)` each frame, `onFail(error)` a frame that did not come. User Timing has each frame as "frame", from
/// its request to its drawing, since the movement began.
export function createLive(canvas, { ask, size, onFrame, onRest, onFail }) {
  const paper = canvas.getContext("2d");
  let isDirty = false;   // something moved since the last request
  let running = null;    // the AbortController of the loop
  let timer = 0;
  let scaleIndex = 0;
  let mean_ms = 0;

  async function draw(signal) {
    const started_ms = performance.now();
    const scale = scales[scaleIndex];
    const image = await ask({ ...frameSize(size(), scale), budget_ms }, signal);
    if (signal.aborted) return;
    paint(image);
    const { duration } = performance.measure("frame", { start: started_ms, detail: scale });
    mean_ms = mean_ms === 0 ? duration : lasting * mean_ms + (1 - lasting) * duration;
    onFrame(1000 / mean_ms);
    adapt();
  }

  function paint(image) {
    if (canvas.width !== image.width || canvas.height !== image.height)
      Object.assign(canvas, { width: image.width, height: image.height });
    paper.putImageData(image, 0, 0);
    canvas.hidden = false;
  }

  function adapt() {
    if (mean_ms > late_ms && scaleIndex < scales.length - 1) scaleIndex += 1;
    else if (mean_ms < early_ms && scaleIndex > 0) scaleIndex -= 1;
    else return;
    mean_ms = 0;  // of other frames
  }

  async function loop(mine) {
    try {
      while (isDirty && !mine.signal.aborted) {
        isDirty = false;
        await draw(mine.signal);
      }
    } catch (error) {
      if (!mine.signal.aborted) {
        clearTimeout(timer);
        onFail(error);
      }
    } finally {
      if (running === mine) running = null;
    }
  }

  return {
    /// Something moved: a frame will show it, and rest follows.
    move() {
      isDirty = true;
      if (timer === 0) performance.clearMeasures("frame");
      clearTimeout(timer);
      timer = setTimeout(() => {
        timer = 0;
        onRest();
      }, rest_ms);
      if (running) return;
      running = new AbortController();
      loop(running);
    },

    /// Ends what is under way; the last frame stays in sight until hide().
    stop() {
      clearTimeout(timer);
      timer = 0;
      isDirty = false;
      running?.abort();
      running = null;
    },

    /// Shows a frame that was not asked for here, ImageData.
    show(frame) {
      paint(frame);
    },

    /// Shows over what is in sight one that is black or transparent where there is nothing yet.
    showPart(part) {
      const words = new Uint32Array(part.data.buffer);
      for (let pixel = 0; pixel < words.length; pixel += 1)
        if (words[pixel] === black) words[pixel] = 0;
      const sheet = new OffscreenCanvas(part.width, part.height);
      sheet.getContext("2d").putImageData(part, 0, 0);
      paper.drawImage(sheet, 0, 0, canvas.width, canvas.height);
    },

    hide() {
      canvas.hidden = true;
    },
  };
}
