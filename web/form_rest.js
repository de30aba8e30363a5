// What is in a scene that the form has no controls for, in words.

const nouns = {
  sphere: ["sphere", "spheres"], cylinder: ["cylinder", "cylinders"], cone: ["cone", "cones"],
  spheres: ["set of spheres", "sets of spheres"], cylinders: ["set of cylinders", "sets of cylinders"],
  cones: ["set of cones", "sets of cones"], sphere_square: ["square of spheres", "squares of spheres"],
  plane: ["plane", "planes"], mesh: ["mesh", "meshes"],
  light: ["light", "lights"], material: ["material", "materials"],
};

/// `counts`: how many the scene has of each type; `shown`: how many of them the form does. "" if that is all.
export function restOf(counts, shown) {
  const left = Object.entries(nouns).map(([type, [one, many]]) => {
    const count = (counts[type] ?? 0) - (shown[type] ?? 0);
    return { count, words: `${count}${shown[type] ? " more" : ""} ${count === 1 ? one : many}` };
  }).filter(({ count }) => count > 0);
  if (left.length === 0) return "";
  const isOne = left.length === 1 && left[0].count === 1;
  return `Also in the scene: ${left.map(({ words }) => words).join(", ")}. Edit ${isOne ? "it" : "them"} as JSON.`;
}
