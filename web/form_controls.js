// The form's controls: each stands for one value of the document, by its pointer.
import { element } from "./element.js";
import { partsOfPointer } from "./json_pointer.js";

const transparent = "transparent";
const defaults = { color: [1, 1, 1], background: [0, 0, 0], ambient: 0.2, kd: 0.7, ks: 0.3, reflectivity: 0, transparency: 0, ior: 1.5, fresnel: false, intensity: 1, angle: 0, radius: 0 };

/// Controls whose changes go to `edit(pointer, value)`. `label` is each one's name for those who hear it.
export function createControls(edit) {
  let fields = [];  // {pointer, read(value)}

  /// `above`, `min`: what it has to be above, and no less than.
  function number(label, pointer, { step = 0.1, min = -Infinity, above = -Infinity } = {}) {
    const input = element("input", { type: "number", step: "any", ariaLabel: label });
    const least = Math.max(min, above);
    if (least > -Infinity) input.min = least;
    const note = element("p", { className: "form-note", role: "alert", id: `form-note-${fields.length}` });
    let kept;    // in the document
    let former;  // there before the typing: digits on the way to what is refused are not meant

    function wrong() {
      if (input.value === "") return input.validity.badInput ? "no number, or too large a one" : "no number";
      if (input.valueAsNumber < min) return `below ${min}`;
      return input.valueAsNumber <= above ? `not above ${above}` : "";
    }

    function tell(why) {
      input.ariaInvalid = why ? "true" : null;
      if (!why) {
        input.removeAttribute("aria-describedby");
        note.remove();
        return;
      }
      input.setAttribute("aria-describedby", note.id);
      const words = `${label}: ${why}.${kept === undefined ? "" : ` The scene keeps ${kept}.`}`;
      if (note.textContent !== words) note.textContent = words;  // it is read aloud anew
      if (!note.isConnected) input.closest(".form-row").append(note);
    }

    input.addEventListener("focus", () => {
      former = kept;
    });
    input.addEventListener("input", () => {
      const why = wrong();
      const next = why ? former : input.valueAsNumber;
      if (next !== kept && next !== undefined) {
        kept = next;
        edit(pointer, next);
      }
      tell(why);
    });
    // "any" allows what was written in the document; the arrows still want a step.
    input.addEventListener("keydown", (event) => {
      const up = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!up || input.value === "") return;
      event.preventDefault();
      const value = input.valueAsNumber;
      // Of what is smaller than a step its second digit.
      const by = value === 0 ? step : Math.min(step, 10 ** (Math.floor(Math.log10(Math.abs(value))) - 1));
      input.value = Number((value + up * by * (event.shiftKey ? 10 : 1)).toPrecision(15));
      input.dispatchEvent(new Event("input"));
    });
    fields.push({ pointer, read(value) {
      const isTyped = document.activeElement === input && (input.valueAsNumber === value || (value === kept && wrong() !== ""));
      kept = value;
      if (isTyped) return;
      input.value = value ?? "";
      former = value;
      tell("");
    } });
    return input;
  }

  function slider(label, pointer, max = 1) {
    const input = element("input", { type: "range", min: 0, max, step: max / 100, ariaLabel: label });
    input.addEventListener("input", () => edit(pointer, input.valueAsNumber));
    fields.push({ pointer, read(value) {
      if (Number.isFinite(value)) input.value = value;
    } });
    return input;
  }

  function colour(label, pointer) {
    const input = element("input", { type: "color", ariaLabel: label });
    let isArray = true;
    input.addEventListener("input", () => edit(pointer, isArray ? partsOf(input.value) : input.value));
    fields.push({ pointer, read(value) {
      if (value === transparent) return;  // what it was until then comes back
      if (typeof value !== "string" && !Array.isArray(value)) return;  // no colour: the server says so
      isArray = Array.isArray(value);
      const hex = isArray ? hexOf(value) : value;
      if (input.value !== hex) input.value = hex;
    } });
    return input;
  }

  function checkbox(label, pointer) {
    const input = element("input", { type: "checkbox", ariaLabel: label });
    input.addEventListener("input", () => edit(pointer, input.checked));
    fields.push({ pointer, read(value) { input.checked = value ?? true; } });
    return input;
  }

  /// A colour, or none.
  function background(label, pointer) {
    const input = colour(`${label}, colour`, pointer);
    const none = element("input", { type: "checkbox", ariaLabel: `${label}, ${transparent}` });
    none.addEventListener("input", () => edit(pointer, none.checked ? transparent : partsOf(input.value)));
    fields.push({ pointer, read(value) { input.disabled = none.checked = value === transparent; } });
    return [input, labelled(transparent, none)];
  }

  /// `options`: [value, words] of each; the first stands for any value that is no string.
  function choice(label, pointer, options) {
    const select = element("select", { ariaLabel: label }, ...options.map(([value, words]) => element("option", { value }, words)));
    select.addEventListener("change", () => edit(pointer, select.value));
    fields.push({ pointer, read(value) {
      select.value = typeof value === "string" ? value : options[0][0];
      select.title = select.selectedOptions[0]?.textContent ?? "";
    } });
    return element("span", { className: "select" }, select);
  }

  return {
    number, slider, colour, checkbox, background, choice,

    /// Other controls come.
    forget() {
      fields = [];
    },

    /// Shows the scene's values.
    read(scene) {
      for (const { pointer, read } of fields) read(valueAt(scene, pointer) ?? defaults[pointer.split("/").pop()]);
    },
  };
}

/// `input` with a word beside it.
export function labelled(text, input) {
  return element("label", {}, element("span", { ariaHidden: "true" }, text), input);
}

function valueAt(scene, pointer) {
  return partsOfPointer(pointer).reduce((value, part) => value?.[part], scene);
}

const hexOf = (parts) => `#${parts.map((part) => Math.round(part * 255).toString(16).padStart(2, "0")).join("")}`;
const partsOf = (hex) => [1, 3, 5].map((at) => Number((parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(3)));
