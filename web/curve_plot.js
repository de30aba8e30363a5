// The measured curve as a plot: tracing time to the right, error upwards, both as powers of ten.

const svg_space = "http://www.w3.org/2000/svg";
const width = 480;
const height = 300;
const room = { left: 74, right: 30, top: 12, bottom: 40 };

/// An SVG of `points` ({trace_ms, rmse, pareto, settings}), of which each with an error is a button:
/// `onChoose(point)` follows a click or Enter on it. `nameOf(point)` says what it is.
export function curvePlot(points, { nameOf, onChoose }) {
  const drawn = points.filter((point) => point.rmse > 0 && point.trace_ms > 0);
  const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "Error against tracing time" });
  const across = axis(drawn.map((point) => point.trace_ms), room.left, width - room.right);
  const up = axis(drawn.map((point) => point.rmse), height - room.bottom, room.top);
  for (const power of across.powers) {
    const x = across.place(10 ** power);
    svg.append(make("line", { x1: x, x2: x, y1: room.top, y2: height - room.bottom, class: "grid" }));
    svg.append(text(x, height - room.bottom + 16, timeText(power), "middle"));
  }
  for (const power of up.powers) {
    const y = up.place(10 ** power);
    svg.append(make("line", { x1: room.left, x2: width - room.right, y1: y, y2: y, class: "grid" }));
    svg.append(text(room.left - 8, y + 4, errorText(power), "end"));
  }
  svg.append(text((room.left + width) / 2, height - 6, "tracing time", "middle"));
  const upwards = text(0, 0, "error", "middle");
  upwards.setAttribute("transform", `translate(14 ${(room.top + height - room.bottom) / 2}) rotate(-90)`);
  svg.append(upwards);
  const best = drawn.filter((point) => kindOf(point) === "point pareto").sort((a, b) => a.trace_ms - b.trace_ms);
  svg.append(make("polyline", { class: "best", points: best.map((point) => `${across.place(point.trace_ms)},${up.place(point.rmse)}`).join(" ") }));
  for (const point of drawn) {
    const mark = make("g", { role: "button", tabindex: 0, "aria-label": nameOf(point), class: kindOf(point) });
    const [x, y] = [across.place(point.trace_ms), up.place(point.rmse)];
    const title = make("title", {});
    title.textContent = nameOf(point);
    mark.append(title, make("circle", { cx: x, cy: y, r: 12, class: "reach" }), make("circle", { cx: x, cy: y, r: 4.5 }));
    const choose = () => {
      for (const other of svg.querySelectorAll(".chosen")) other.classList.remove("chosen");
      mark.classList.add("chosen");
      onChoose(point);
    };
    mark.addEventListener("click", choose);
    mark.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      choose();
    });
    svg.append(mark);
  }
  return svg;
}

function kindOf(point) {
  if (point.changes_picture) return "point changed";
  return point.pareto ? "point pareto" : "point";
}

/// From the power of ten below the least value to the one above the largest.
function axis(values, from, to) {
  const low = Math.floor(Math.log10(Math.min(...values)));
  const high = Math.max(low + 1, Math.ceil(Math.log10(Math.max(...values))));
  const place = (value) => from + ((Math.log10(value) - low) / (high - low)) * (to - from);
  return { place, powers: Array.from({ length: high - low + 1 }, (_, index) => low + index) };
}

const timeText = (power) => (power >= 3 ? `${10 ** (power - 3)} s` : `${decimal(power)} ms`);
const errorText = (power) => (power >= -4 ? decimal(power) : `1e${power}`);
const decimal = (power) => (10 ** power).toFixed(Math.max(0, -power));

function text(x, y, words, anchor) {
  const made = make("text", { x, y, "text-anchor": anchor });
  made.textContent = words;
  return made;
}

function make(tag, attributes) {
  const made = document.createElementNS(svg_space, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
