// Reads a document's text beside the page: see outline.js.
import { outlineOf } from "./outline.js";

addEventListener("message", ({ data }) => postMessage(outlineOf(data)));
