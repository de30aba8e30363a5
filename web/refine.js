// From a view at rest to its picture: what is to be expected, previews if that is long, the picture.
// What takes no longer than its first preview is worth is one request; what does is a job, whose
// picture is seen as it comes.
import { jobFrame, jobImage, plan, render, renderFrame } from "./api.js";
import { frameSize } from "./frame.js";
import { withJob } from "./job.js";

const previews_ms = [150, 1000];  // of tracing
const worth = 4;                  // times as long the picture has to take, for a preview
const rest = 3;                   // times as long as a look at the unfinished picture took, until the next

/// `source`: see scene_source.js; `size`: the picture's {width, height}. onPlan(plan), onPreview(frame)
/// and onPart(frame that is black or transparent where it is not done), both ImageData, come before what this
/// resolves to, api.js's render(). Rejects as that does.
export async function refine({ source, text, view, settings, size, onPlan, onPreview, onPart }, signal) {
  return source.with(text, view, settings, signal, async (what) => {
    const planned = await plan(what, signal);
    onPlan(planned);
    const { samples, target_rmse, ...others } = what.query;
    const worthwhile = previews_ms.filter((budget_ms) => planned.prediction.trace_ms >= worth * budget_ms);
    if (worthwhile.length === 0) return render(what, signal);
    for (const budget_ms of worthwhile)
      onPreview(await renderFrame({ ...what, query: { ...others, ...frameSize(size), budget_ms } }, signal));
    return withJob("render", what, signal, watch(onPart, signal), (id) => jobImage(id, signal));
  });
}

// What follows a job's progress: one look at a time, and a rest after each.
function watch(onPart, signal) {
  let next_ms = 0;
  return async ({ id, progress }) => {
    const begun_ms = performance.now();
    if (progress === 0 || progress === 1 || begun_ms < next_ms) return;
    next_ms = Infinity;
    try {
      const frame = await jobFrame(id, signal);
      if (frame && !signal.aborted) onPart(frame);
    } catch (error) {
      if (!signal.aborted) console.debug(error);  // the job says itself what became of it
    }
    next_ms = performance.now() + rest * (performance.now() - begun_ms);
  };
}
