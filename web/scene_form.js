// The common edits as a form beside the JSON: each control stands for one value of the document,
// by its pointer, and writes that value alone into the text.
import { element } from "./element.js";

// The kinds of objects that the form edits: the points of each, what else they have, and their names.
const kinds = {
  sphere: { title: "Sphere", points: ["center"], radii: { radius: "r" }, flags: [] },
  cylinder: { title: "Cylinder", points: ["from", "to"], radii: { radius: "r" }, flags: ["caps"] },
  cone: { title: "Cone", points: ["from", "to"], radii: { radius_from: "r from", radius_to: "r to" }, flags: ["caps"] },
};

/// `panel` holds #form, which is filled by show(), and #form-rests, which says why it cannot be.
/// `onEdit(pointer, value)` follows each change of a value; `onAdd(list, type)` and `onRemove(list, index)`
/// the buttons of the lists at these pointers.
export function createSceneForm(panel, { onEdit, onAdd, onRemove }) {
  const [box, rests] = ["form", "form-rests"].map((id) => panel.querySelector(`#${id}`));
  let isBehind = false;  // the text is another than is shown: the pointers may lead to other values
  let shape = "";   // of the document that the controls were made for
  let fields = [];  // {pointer, read(value)}

  function edit(pointer, value) {
    if (!isBehind) onEdit(pointer, value);
  }

  function add(list, type) {
    if (!isBehind) onAdd(list, type);
  }

  function remove(list, index) {
    if (isBehind) return;
    isBehind = true;
    onRemove(list, index);
  }

  function number(label, pointer, { step = 0.1, min } = {}) {
    const input = element("input", { type: "number", step: "any", ariaLabel: label });
    if (min !== undefined) input.min = min;
    input.addEventListener("input", () => {
      if (input.value !== "" && input.checkValidity()) edit(pointer, input.valueAsNumber);
    });
    // "any" allows what was written in the document; the arrows still want a step.
    input.addEventListener("keydown", (event) => {
      const up = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!up || input.value === "") return;
      event.preventDefault();
      input.value = Number((input.valueAsNumber + up * step * (event.shiftKey ? 10 : 1)).toFixed(6));
      input.dispatchEvent(new Event("input"));
    });
    fields.push({ pointer, read(value) {
      if (document.activeElement !== input || input.valueAsNumber !== value) input.value = value ?? "";
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

  // A colour, or none.
  function background(label, pointer) {
    const input = colour(`${label}, colour`, pointer);
    const none = element("input", { type: "checkbox", ariaLabel: `${label}, ${transparent}` });
    none.addEventListener("input", () => edit(pointer, none.checked ? transparent : partsOf(input.value)));
    fields.push({ pointer, read(value) { input.disabled = none.checked = value === transparent; } });
    return [input, labelled(transparent, none)];
  }

  function choice(label, pointer, words) {
    const select = element("select", { ariaLabel: label }, ...words.map((word) => element("option", { value: word }, word.replace("_", " "))));
    select.addEventListener("change", () => edit(pointer, select.value));
    fields.push({ pointer, read(value) { select.value = value ?? words[0]; } });
    return select;
  }

  function remover(name, list, index) {
    const made = button("×", () => remove(list, Number(index)));
    made.ariaLabel = made.title = `Remove ${name}`;
    return made;
  }

  const point = (label, pointer) => ["x", "y", "z"].map((axis, index) => labelled(axis, number(`${label}, ${axis}`, `${pointer}/${index}`)));

  function make(scene) {
    fields = [];
    const groups = [];
    for (const [type, { title, points, radii, flags }] of Object.entries(kinds)) {
      const rows = [];
      for (const [index, object] of Object.entries(scene.objects)) {
        if (object.type !== type || !points.every((key) => Array.isArray(object[key]))) continue;
        const pointer = `/objects/${index}`;
        const name = `${title} ${rows.length + 1}`;
        rows.push(row(name, materialOf(object), [
          ...points.flatMap((key) => point(points.length > 1 ? `${name}, ${key}` : name, `${pointer}/${key}`)),
          ...Object.entries(radii).map(([key, label]) =>
            labelled(label, number(`${name}, ${key.replace("_", " ")}`, `${pointer}/${key}`, { min: 0 }))),
          ...flags.map((key) => labelled(key, checkbox(`${name}, ${key}`, `${pointer}/${key}`))), remover(name, "/objects", index)]));
      }
      rows.push(button(`Add a ${type}`, () => add("/objects", type)));
      groups.push(group(`${title}s`, rows));
    }

    const materials = Object.keys(scene.materials).map((name) => {
      const pointer = `/materials/${name.replaceAll("~", "~0").replaceAll("/", "~1")}`;
      return row(name, "", [
        colour(`${name}, colour`, `${pointer}/color`),
        labelled("matt", slider(`${name}, diffuse`, `${pointer}/kd`)),
        labelled("glossy", slider(`${name}, specular`, `${pointer}/ks`)),
        labelled("mirror", slider(`${name}, reflectivity`, `${pointer}/reflectivity`)),
        labelled("glass", slider(`${name}, transparency`, `${pointer}/transparency`)),
        labelled("index", number(`${name}, index of refraction`, `${pointer}/ior`, { step: 0.05, min: 1 })),
        labelled("Fresnel", checkbox(`${name}, Fresnel`, `${pointer}/fresnel`))], "material");
    });
    if (materials.length > 0) groups.push(group("Materials", materials));

    const lights = scene.lights.map((light, index) => {
      const pointer = `/lights/${index}`;
      const where = { point: "position", distant: "direction" }[light?.type];
      const name = `Light ${index + 1}`;
      return row(name, [light?.type, where].filter(Boolean).join(", "), [
        colour(`${name}, colour`, `${pointer}/color`), ...(where ? point(`${name}, ${where}`, `${pointer}/${where}`) : []),
        labelled("intensity", number(`${name}, intensity`, `${pointer}/intensity`, { min: 0 })),
        ...(where === "direction" ? [labelled("softness", slider(`${name}, angle`, `${pointer}/angle`))] : []),
        ...(where === "position" ? [labelled("softness", slider(`${name}, radius`, `${pointer}/radius`, widestRadius(light))), labelled("falloff", choice(`${name}, falloff`, `${pointer}/falloff`, ["inverse_square", "none"]))] : []),
        ...(light?.type === "sky" ? [remover(name, "/lights", index)] : [])]);
    });
    if (!scene.lights.some((light) => light?.type === "sky")) lights.push(button("Add a sky", () => add("/lights", "sky")));
    groups.push(group("Lights", lights));
    groups.push(group("Surroundings", [
      row("Background", "", background("Background", "/background")),
      row("Ambient light", "", [labelled("", slider("Ambient light", "/ambient"))], "material")]));
    const refocus = focusIn(box);
    box.replaceChildren(...groups);
    refocus();
  }

  // Makes the controls anew only if the scene has other things in it.
  function fill(scene) {
    const next = shapeOf(scene);
    if (next !== shape) make(scene);
    shape = next;
    for (const { pointer, read } of fields) read(valueAt(scene, pointer) ?? defaults[pointer.split("/").pop()]);
  }

  return {
    /// Shows the values of an outline's scene. What it cannot show it does not edit either, and says so:
    /// whoever calls goes on.
    show(outline) {
      let why = outline ? "" : "The text is no scene now, and nothing here can change it. Render says what is wrong.";
      try {
        if (outline) fill(outline.scene);
      } catch (error) {
        why = `This form cannot show the scene: ${error.message}.`;
      }
      rests.textContent = why;
      rests.hidden = why === "";
      box.inert = why !== "";
      isBehind = false;
    },

    /// The text was changed elsewhere: until show(), nothing is written by pointers that may be out of date.
    fallBehind() {
      isBehind = true;
    },
  };
}

const transparent = "transparent";
const defaults = { color: [1, 1, 1], background: [0, 0, 0], ambient: 0.2, kd: 0.7, ks: 0.3, reflectivity: 0, transparency: 0, ior: 1.5, fresnel: false, intensity: 1, angle: 0, radius: 0 };

/// Of a lamp, by how far it is from the middle of where most scenes are.
const widestRadius = ({ position }) => Number((Array.isArray(position) && Math.hypot(...position) / 4 || 1).toPrecision(1));

/// What decides which controls there are.
function shapeOf({ objects, materials, lights }) {
  const kinds = (list) => Object.entries(list).map(([index, each]) => [index, each?.type, materialOf(each)]);
  return JSON.stringify([kinds(objects), Object.keys(materials), kinds(lights)]);
}

const materialOf = (object) => (typeof object?.material === "string" ? object.material : "");

function valueAt(scene, pointer) {
  return pointer.split("/").slice(1).reduce((value, part) => value?.[part.replaceAll("~1", "/").replaceAll("~0", "~")], scene);
}

const hexOf = (parts) => `#${parts.map((part) => Math.round(part * 255).toString(16).padStart(2, "0")).join("")}`;
const partsOf = (hex) => [1, 3, 5].map((at) => Number((parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(3)));

// A function that gives the focus to the control of the name that has it now, or to the last button
// of its group where that is gone, such as Add after Remove.
function focusIn(box) {
  const nameOf = (control) => control.ariaLabel ?? control.textContent;
  const { activeElement } = document;
  if (!box.contains(activeElement)) return () => {};
  const name = nameOf(activeElement);
  const place = [...box.children].indexOf(activeElement.closest("fieldset"));
  return () => {
    const controls = [...box.querySelectorAll("input, select, button")];
    const same = controls.find((control) => nameOf(control) === name);
    (same ?? [...box.children[place]?.querySelectorAll("button") ?? []].at(-1))?.focus();
  };
}

function group(title, rows) {
  return element("fieldset", {}, element("legend", {}, title), ...rows);
}

function row(name, about, controls, kind = "") {
  const heading = element("span", { className: "form-name" }, name);
  if (about) heading.append(" ", element("small", {}, about));
  return element("div", { className: `form-row ${kind}` }, heading, element("div", {}, ...controls));
}

function labelled(text, input) {
  return element("label", {}, element("span", { ariaHidden: "true" }, text), input);
}

function button(text, onPress) {
  const made = element("button", { type: "button", className: "quiet" }, text);
  made.addEventListener("click", onPress);
  return made;
}
