// The one control between "instant" and "exact": what it asks for, and beside it the time and
// error that were predicted and those that came true.
import { passFocus } from "./focus.js";
import { duration, pluralised } from "./units.js";

const steps = [
  ["Instant", "what 10 ms give", { budget_ms: 10 }],
  ["Quick", "what 50 ms give", { budget_ms: 50 }],
  ["Draft", "error 0.02", { target_rmse: 0.02 }],
  ["Fair", "error 0.01", { target_rmse: 0.01 }],
  ["Good", "error 0.005", { target_rmse: 0.005 }],
  ["Fine", "error 0.002", { target_rmse: 0.002 }],
  ["Finer", "error 0.001", { target_rmse: 0.001 }],
  ["Exact", "error 0.0005, half of what 8 bits round away", { target_rmse: 0.0005 }],
];

/// `box` holds #accuracy, #as-written, #accuracy-says and #outcome. `onChange()` follows a change.
export function createAccuracy(box, onChange) {
  const [slider, asWritten, says, outcome] = ["accuracy", "as-written", "accuracy-says", "outcome"].map((id) => box.querySelector(`#${id}`));
  slider.max = steps.length - 1;
  let isWritten = true;
  let other = null;  // {settings, words} that no step stands for

  function show() {
    const [name, means] = steps[slider.valueAsNumber];
    const words = other?.words ?? (isWritten ? "As the scene says" : `${name}: ${means}`);
    says.textContent = words;
    slider.setAttribute("aria-valuetext", words);
    asWritten.hidden = isWritten && !other;
    box.classList.toggle("is-written", isWritten || other !== null);
  }

  slider.addEventListener("input", () => {
    other = null;
    isWritten = false;
    show();
    onChange();
  });
  asWritten.addEventListener("click", () => {
    passFocus(asWritten, slider);
    other = null;
    isWritten = true;
    show();
    onChange();
  });
  show();

  return {
    slider,
    /// What stands over the document's own, as query parameters.
    get settings() {
      if (other) return other.settings;
      return isWritten ? {} : steps[slider.valueAsNumber][2];
    },
    /// What is chosen, in words.
    get words() {
      return says.textContent;
    },
    /// What is chosen, for a link: {accuracy: the step's number}, or the settings that none stands for.
    get choice() {
      return isWritten || other ? this.settings : { accuracy: slider.valueAsNumber };
    },
    /// Chooses so, without onChange().
    set choice({ accuracy, ...settings }) {
      const step = steps.findIndex(([,, asked]) => JSON.stringify(asked) === JSON.stringify(settings));
      if (step >= 0) [accuracy, settings] = [step, {}];
      other = Object.keys(settings).length > 0 ? { settings, words: settingsText(settings) } : null;
      isWritten = !(accuracy in steps);
      if (!isWritten) slider.value = accuracy;
      show();
    },

    /// Chooses settings that no step stands for; gives what onChange() does.
    choose(settings) {
      this.choice = settings;
      return onChange();
    },

    /// Before the render: its plan's prediction, or null if none was to be had.
    predict(prediction) {
      fill(outcome, "predicted", prediction && {
        trace_ms: prediction.trace_ms, error: prediction.error, samples: prediction.samples,
      });
      fill(outcome, "measured", null);
    },
    /// After it: what api.js's render() gave.
    report({ stages, cache, error, samples }) {
      const trace = stages.find(({ name }) => name === "trace");
      fill(outcome, "measured", { trace_ms: trace?.ms, error: error && Number(error), samples: samples && Number(samples) });
      if (cache) outcome.querySelector('[data-row="measured"] [data-is="trace_ms"]').textContent = cache === "hit" ? "cached" : "shared";
    },
  };
}

function fill(table, row, values) {
  const shown = {
    trace_ms: values?.trace_ms === undefined ? null : duration(values.trace_ms),
    error: errorText(values?.error),
    samples: values?.samples ? String(Number(values.samples.toPrecision(3))) : null,
  };
  for (const [name, text] of Object.entries(shown))
    table.querySelector(`[data-row="${row}"] [data-is="${name}"]`).textContent = text ?? "–";
}

/// "16 samples, double precision".
export function settingsText({ samples, target_rmse, precision, shadows, max_depth, ...others }) {
  return [
    samples && pluralised(samples, "sample"), target_rmse && `target ${target_rmse}`,
    precision && `${precision} precision`, shadows && "no shadows", max_depth === 0 && "no reflections",
    ...Object.entries(others).map(([name, value]) => `${name} ${value}`),
  ].filter(Boolean).join(", ");
}

/// Two digits suffice for an estimate.
export function errorText(error) {
  if (error === null || error === undefined || Number.isNaN(error)) return null;
  return String(Number(error.toPrecision(2)));
}
