// The common edits as a form beside the JSON: each control stands for one value of the document,
// by its pointer, and writes that value alone into the text.
import { element } from "./element.js";
import { createControls, labelled } from "./form_controls.js";
import { restOf } from "./form_rest.js";

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
  const { number, slider, colour, checkbox, background, choice, ...controls } = createControls((pointer, value) => {
    if (!isBehind) onEdit(pointer, value);
  });

  function add(list, type) {
    if (!isBehind) onAdd(list, type);
  }

  function remove(list, index) {
    if (isBehind) return;
    isBehind = true;
    onRemove(list, index);
  }

  function remover(name, list, index) {
    const made = button("×", () => remove(list, Number(index)));
    made.ariaLabel = made.title = `Remove ${name}`;
    return made;
  }

  function adders(list, types) {
    return element("div", { className: "form-adders" }, ...types.map(([type, words]) => button(`Add a ${words}`, () => add(list, type))));
  }

  // Three numbers; on a line with a `word` where the row has more than them.
  function point(label, pointer, word = "") {
    const numbers = ["x", "y", "z"].map((axis, index) => labelled(axis, number(`${label}, ${axis}`, `${pointer}/${index}`)));
    return word ? [element("div", { className: "form-point" }, element("span", { ariaHidden: "true" }, word), ...numbers)] : numbers;
  }

  // What a document names can be chosen; what stands in an object's place is lost to that, until Undo.
  function material(name, object, pointer, materials) {
    const names = [...new Set([...Object.keys(materials), ...[object.material].filter((each) => typeof each === "string")])];
    if (names.length === 0) return "";
    const other = object.material === undefined ? [["", "default"]] : [["", "its own"]];
    return choice(`${name}, material`, `${pointer}/material`,
      [...(typeof object.material === "string" ? [] : other), ...names.map((each) => [each, each])]);
  }

  function objectRow(name, type, object, index, materials) {
    const { points, radii, flags } = kinds[type];
    const pointer = `/objects/${index}`;
    return row(name, material(name, object, pointer, materials), [
      ...points.flatMap((key) => (points.length > 1 ? point(`${name}, ${key}`, `${pointer}/${key}`, key) : point(name, `${pointer}/${key}`))),
      ...Object.entries(radii).map(([key, label]) =>
        labelled(label, number(`${name}, ${key.replace("_", " ")}`, `${pointer}/${key}`, key === "radius" ? { above: 0 } : { min: 0 }))),
      ...flags.map((key) => labelled(key, checkbox(`${name}, ${key}`, `${pointer}/${key}`))), remover(name, "/objects", index)]);
  }

  function materialRow(name) {
    const pointer = `/materials/${name.replaceAll("~", "~0").replaceAll("/", "~1")}`;
    return row(name, "", [
      colour(`${name}, colour`, `${pointer}/color`),
      labelled("matt", slider(`${name}, diffuse`, `${pointer}/kd`)),
      labelled("glossy", slider(`${name}, specular`, `${pointer}/ks`)),
      labelled("mirror", slider(`${name}, reflectivity`, `${pointer}/reflectivity`)),
      labelled("glass", slider(`${name}, transparency`, `${pointer}/transparency`)),
      labelled("index", number(`${name}, index of refraction`, `${pointer}/ior`, { step: 0.05, min: 1 })),
      labelled("Fresnel", checkbox(`${name}, Fresnel`, `${pointer}/fresnel`))], "material");
  }

  function lightRow(light, index) {
    const pointer = `/lights/${index}`;
    const where = { point: "position", distant: "direction" }[light?.type];
    const name = `Light ${index + 1}`;
    return row(name, element("small", {}, light?.type ?? ""), [
      colour(`${name}, colour`, `${pointer}/color`),
      labelled("intensity", number(`${name}, intensity`, `${pointer}/intensity`, { min: 0 })),
      ...(where ? point(`${name}, ${where}`, `${pointer}/${where}`, where) : []),
      ...(where === "direction" ? [labelled("softness", slider(`${name}, angle`, `${pointer}/angle`))] : []),
      ...(where === "position" ? [
        labelled("softness", slider(`${name}, radius`, `${pointer}/radius`, widestRadius(light))),
        labelled("falloff", choice(`${name}, falloff`, `${pointer}/falloff`, [["inverse_square", "inverse square"], ["none", "none"]]))] : []),
      remover(name, "/lights", index)]);
  }

  function make(scene) {
    controls.forget();
    const groups = [];
    const shown = { light: scene.lights.length, material: Object.keys(scene.materials).length };
    for (const [type, { title, points }] of Object.entries(kinds)) {
      const rows = [];
      for (const [index, object] of Object.entries(scene.objects))
        if (object.type === type && points.every((key) => Array.isArray(object[key])))
          rows.push(objectRow(`${title} ${rows.length + 1}`, type, object, index, scene.materials));
      shown[type] = rows.length;
      groups.push(group(`${title}s`, [...rows, adders("/objects", [[type, type]])]));
    }
    const rest = restOf(scene.counts, shown);
    if (rest) groups.push(element("p", { className: "form-rest" }, rest));
    const materials = Object.keys(scene.materials).map(materialRow);
    if (materials.length > 0) groups.push(group("Materials", materials));
    const hasSky = scene.lights.some((light) => light?.type === "sky");
    const lights = [...scene.lights.map(lightRow),
      adders("/lights", [["distant", "distant light"], ["point", "point light"], ...(hasSky ? [] : [["sky", "sky"]])])];
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
    controls.read(scene);
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

/// Of a lamp, by how far it is from the middle of where most scenes are.
const widestRadius = ({ position }) => Number((Array.isArray(position) && Math.hypot(...position) / 4 || 1).toPrecision(1));

/// What decides which controls there are.
function shapeOf({ objects, materials, lights, counts }) {
  const kinds = (list) => Object.entries(list).map(([index, each]) => [index, each?.type, materialOf(each)]);
  return JSON.stringify([kinds(objects), Object.keys(materials), kinds(lights), counts]);
}

const materialOf = (object) => (typeof object?.material === "object" ? {} : object?.material);

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
  if (about) heading.append(" ", about);
  return element("div", { className: `form-row ${kind}` }, heading, element("div", {}, ...controls));
}

function button(text, onPress) {
  const made = element("button", { type: "button", className: "quiet" }, text);
  made.addEventListener("click", onPress);
  return made;
}
