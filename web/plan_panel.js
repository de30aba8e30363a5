// The plan in words: what the engine chose for this view of the scene, and why.
import { pluralised, duration } from "./units.js";
import { errorText } from "./accuracy.js";

const titles = {
  precision: "Precision", geometry: "Geometry", sampling: "Sampling", integration: "Pixels by", kernel: "Kernel",
  instruction_set: "Instruction set", tiles: "Tiles", frame: "Frame",
};

/// `plan`: the answer to POST /plan.
export function showPlan(box, plan) {
  const parts = [entry("Expected", expected(plan.prediction), plan.prediction.time_reason, plan.prediction.error_reason)];
  parts.push(entry("What the scene needs", features(plan.features)));
  for (const [name, title] of Object.entries(titles)) {
    if (!plan[name]) continue;
    const { choice, reason, ways } = plan[name];
    const made = entry(title, name === "sampling" ? `${pluralised(choice, "sample")} per pixel` : String(choice), ways ? undefined : reason);
    if (ways) made.append(listOf(ways));
    parts.push(made);
  }
  box.replaceChildren(...parts);
}

function expected({ trace_ms, error, threads }) {
  return `${duration(trace_ms)} of tracing on ${pluralised(threads, "thread")}, an error of ${errorText(error) ?? "unknown size"}`;
}

function features({ objects, lights, shadows, shading, reflections, materials }) {
  const some = (counts) => Object.entries(counts).filter(([, count]) => count > 0)
    .map(([name, count]) => `${count} ${plain(count === 1 ? name.replace(/s$/, "") : name)}`).join(", ") || "none";
  return `Objects: ${some(objects)}. Lights: ${some(lights)}. Shadows: ${shadows}. ${pluralised(materials, "material")}, `
    + `shading ${shading.join(", ") || "none"}, ${reflections ? `up to ${pluralised(reflections, "reflection")}` : "no reflections"}.`;
}

const plain = (name) => name.replaceAll("_", " ");

function entry(title, choice, ...reasons) {
  const section = document.createElement("section");
  section.append(element("h2", title), element("p", choice, "choice"));
  for (const reason of reasons) if (reason) section.append(element("p", reason, "reason"));
  return section;
}

function listOf(ways) {
  const list = document.createElement("ul");
  for (const { objects, rays, choice, reason } of ways) {
    const item = element("li", "");
    item.append(element("strong", `${choice}: `), `${objects}, rays ${rays}. `, element("span", reason, "reason"));
    list.append(item);
  }
  return list;
}

function element(tag, text, className = "") {
  const made = document.createElement(tag);
  made.textContent = text;
  made.className = className;
  return made;
}
