// A scene in a link: its text, compressed, in the fragment, which no server sees. And as a command.
import { readView, viewText } from "./view.js";

/// The fragment for a state: {name} of a shipped scene or {text}, {view} or null, {step} or null.
export async function fragmentOf({ name, text, view, step }) {
  const parameters = new URLSearchParams(name ? { scene: name } : { document: await packed(text) });
  if (view) parameters.set("view", viewText(view));
  if (step !== null) parameters.set("accuracy", step);
  return `#${parameters}`;
}

/// The state of a fragment; what it does not say is null. Rejects if its document is damaged.
export async function readFragment(hash) {
  const parameters = new URLSearchParams(hash.slice(1));
  const document = parameters.get("document");
  return {
    name: document ? null : parameters.get("scene"),
    text: document ? await unpacked(document) : null,
    view: readView(parameters.get("view")),
    step: parameters.has("accuracy") ? Number(parameters.get("accuracy")) : null,
  };
}

/// The command that renders `text` with `settings` to NAME.png.
export function curlCommand(text, settings, name) {
  const query = new URLSearchParams(settings).toString();
  const address = new URL(`render${query && `?${query}`}`, location.href.split("#")[0]);
  const end = text.includes("\nSCENE\n") ? "END_OF_SCENE" : "SCENE";
  return `curl --fail --header 'Content-Type: application/json' --output ${name}.png --data-binary @- '${address}' <<'${end}'\n${text.trimEnd()}\n${end}\n`;
}

async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of new Uint8Array(await new Response(stream).arrayBuffer())) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpacked(base64url) {
  const binary = atob(base64url.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
}
