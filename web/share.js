// A scene in a link: its text, compressed, in the fragment, which no server sees. And as a command.
import { authorization } from "./token.js";
import { readView, viewText } from "./view.js";

const settings = ["samples", "target_rmse", "budget_ms", "max_depth", "precision", "transfer"];  // of a query

/// The fragment for a state: {name} of a shipped scene or {text}, {view} or null, {choice}: accuracy.js's.
export async function fragmentOf({ name, text, view, choice }) {
  const parameters = new URLSearchParams(name ? { scene: name } : text && { document: await packed(text) });
  if (view) parameters.set("view", viewText(view));
  for (const [key, value] of Object.entries(choice)) parameters.set(key, value);
  return `#${parameters}`;
}

/// The state of a fragment; what it does not say is null, and so is its document if that is damaged.
export async function readFragment(hash) {
  const parameters = new URLSearchParams(hash.slice(1));
  const document = parameters.get("document");
  const text = document && await unpacked(document).catch(() => null);
  return {
    name: document ? null : parameters.get("scene"),
    text,
    isDamaged: document !== null && text === null,
    view: readView(parameters.get("view")),
    choice: Object.fromEntries(["accuracy", ...settings].filter((key) => parameters.has(key)).map((key) => {
      const value = parameters.get(key);
      return [key, value === "" || Number.isNaN(Number(value)) ? value : Number(value)];
    })),
  };
}

/// The command that renders `text` with `settings` to NAME.png.
export function curlCommand(text, settings, name) {
  const query = new URLSearchParams(settings).toString();
  const address = new URL(`render${query && `?${query}`}`, location.href.split("#")[0]);
  const end = text.includes("\nSCENE\n") ? "END_OF_SCENE" : "SCENE";
  // Whoever gets the command has a token of their own.
  const proof = authorization().Authorization ? ' --header "Authorization: Bearer $RAYTRACER_TOKEN"' : "";
  return `curl --fail --header 'Content-Type: application/json'${proof} --output ${name}.png --data-binary @- '${address}' <<'${end}'\n${text.trimEnd()}\n${end}\n`;
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
