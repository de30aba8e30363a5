// From a view at rest to its picture: what is to be expected, a preview if that is long, the picture.
import { plan, render, renderFrame } from "./api.js";

const preview_after_ms = 600;  // of tracing
const preview = { budget_ms: 150 };

/// `source`: see scene_source.js. onPlan(plan) and onPreview(bytes of a PPM) come before what this
/// resolves to, api.js's render(). Rejects as that does.
export async function refine({ source, text, view, settings, onPlan, onPreview }, signal) {
  return source.with(text, view, settings, signal, async (what) => {
    const foreseen = await plan(what, signal);
    onPlan(foreseen);
    if (foreseen.prediction.trace_ms > preview_after_ms) {
      const { samples, target_rmse, ...rest } = what.query;
      onPreview(await renderFrame({ ...what, query: { ...rest, ...preview } }, signal));
    }
    return render(what, signal);
  });
}
