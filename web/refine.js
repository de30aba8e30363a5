// From a view at rest to its picture: what is to be expected, previews if that is long, the picture.
import { plan, render, renderFrame } from "./api.js";

const previews_ms = [150, 1000];  // of tracing
const widest_px = 1000;           // of a preview
const worth = 4;                  // times as long the picture has to take, for a preview

/// `source`: see scene_source.js; `size`: the picture's {width, height}. onPlan(plan) and onPreview(bytes of a PPM) come before what this
/// resolves to, api.js's render(). Rejects as that does.
export async function refine({ source, text, view, settings, size, onPlan, onPreview }, signal) {
  return source.with(text, view, settings, signal, async (what) => {
    const foreseen = await plan(what, signal);
    onPlan(foreseen);
    const { samples, target_rmse, ...rest } = what.query;
    const part = Math.min(1, widest_px / size.width);
    const [width, height] = [size.width, size.height].map((length) => Math.max(1, Math.round(length * part)));
    for (const budget_ms of previews_ms) {
      if (foreseen.prediction.trace_ms < worth * budget_ms) break;
      onPreview(await renderFrame({ ...what, query: { ...rest, width, height, budget_ms } }, signal));
    }
    return render(what, signal);
  });
}
