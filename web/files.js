// Files that a person opens or drops onto the page. It reads scene documents alone; of any other file it
// says which command shows it, since the readers of all formats are the client's.
import { Problem } from "./api.js";

// What `raytracer convert --help` lists, packed or not, and LAMMPS's dump.NAME.
const read_by_client = /(\.(nff|pdb|ent|cif|mmcif|xyz|extxyz|dump|lammpstrj|csv|tsv|ply|obj|stl|gltf|glb)|^dump\..+?)(\.(gz|zst))?$/i;

/// Takes what is dropped anywhere, and what `chooser`, an input of files that `opener` opens, is given; it
/// closes the `gallery`, which would hide what comes of it. `onScene(text, name)` gets a document and its
/// file's name, `onProblem(problem)` why there is none.
export function acceptFiles({ gallery, opener, chooser }, { onScene, onProblem }) {
  const root = document.documentElement;
  const holdsFiles = ({ dataTransfer }) => dataTransfer.types.includes("Files");

  async function take(files) {
    gallery.close();
    try {
      onScene(await documentOf(files), files[0].name);
    } catch (error) {
      onProblem(error);
    }
  }

  document.addEventListener("dragover", (event) => {
    if (!holdsFiles(event)) return;  // text, which the editor takes
    event.preventDefault();
    event.dataTransfer.dropEffect = "copy";
    root.classList.add("receiving");
  });
  document.addEventListener("dragleave", ({ relatedTarget }) => {
    if (relatedTarget === null) root.classList.remove("receiving");
  });
  document.addEventListener("drop", (event) => {
    root.classList.remove("receiving");
    if (!holdsFiles(event)) return;
    event.preventDefault();  // or the browser would leave the page for the file
    take([...event.dataTransfer.files]);
  });
  opener.addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    take([...chooser.files]);
    chooser.value = "";  // the same file may be chosen again
  });
}

async function documentOf(files) {
  if (files.length > 1) throw new Problem({ title: "One file at a time", detail: `These are ${files.length}.` });
  const [file] = files;
  if (!/\.json$/i.test(file.name)) {
    throw new Problem({
      title: "This page opens scene documents (.json)",
      detail: read_by_client.test(file.name)
        ? `For molecules, particles and meshes, in a terminal: raytracer open ${quoted(file.name)}`
        : `${file.name} is none, by its name.`,
    });
  }
  return file.text().catch((error) => {
    throw new Problem({ title: `${file.name} cannot be read`, detail: error.message });
  });
}

// As a shell takes it for one word.
function quoted(name) {
  const word = name.startsWith("-") ? `./${name}` : name;
  return /^[\w.,:+@%/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
