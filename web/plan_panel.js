// The plan in words: what the engine chose for this view of the scene, and why.
import { pluralised, duration } from "./units.js";
import { errorText } from "./accuracy.js";
import { element } from "./element.js";

const titles = {
  precision: "Precision", geometry: "Geometry", sampling: "Sampling", light_samples: "Light samples", kernel: "Kernel",
  instruction_set: "Instruction set", tiles: "Tiles", frame: "Frame",
};

/// `plan`: the answer to POST /plan.
export function showPlan(box, plan) {
  const parts = [entry("Expected", expected(plan.prediction), plan.prediction.time_reason, plan.prediction.error_reason)];
  parts.push(entry("What the scene needs", features(plan.features)));
  for (const [name, title] of Object.entries(titles)) {
    if (!plan[name]) continue;
    const { choice, reason, finders } = plan[name];
    const made = entry(title, name === "sampling" ? `${pluralised(choice, "sample")} per pixel` : String(choice), finders ? undefined : reason);
    if (finders) made.append(listOf(finders));
    parts.push(made);
  }
  box.replaceChildren(...parts);
}

function expected({ trace_ms, error, threads }) {
  return `${duration(trace_ms)} of tracing on ${pluralised(threads, "thread")}, an error of ${errorText(error) ?? "unknown size"}`;
}

function features({ objects, lights, shadows, shading, reflections, refractions, materials }) {
  const some = (counts) => Object.entries(counts).filter(([, count]) => count > 0)
    .map(([name, count]) => `${count} ${plain(count === 1 ? name.replace(/s$/, "") : name)}`).join(", ") || "none";
  return `Objects: ${some(objects)}. Lights: ${some(lights)}. Shadows: ${shadows}. ${pluralised(materials, "material")}, `
    + `shading ${shading.join(", ") || "none"}, ${followed(reflections, refractions)}.`;
}

function followed(reflections, refractions) {
  if (refractions > 0) return `up to ${refractions} reflections and refractions`;
  return reflections > 0 ? `up to ${pluralised(reflections, "reflection")}` : "no reflections";
}

const plain = (name) => name.replaceAll("_", " ");

function entry(title, choice, ...reasons) {
  return element("section", {}, element("h2", {}, title), worded("p", choice, "choice"),
    ...reasons.filter(Boolean).map((reason) => worded("p", reason, "reason")));
}

function listOf(finders) {
  return element("ul", {}, ...finders.map(({ objects, rays, choice, reason }) => element("li", {},
    element("strong", {}, `${choice}: `), `${objects}, rays ${rays}, because `, worded("span", reason, "reason"))));
}

const worded = (tag, text, className) => element(tag, { className }, text);
