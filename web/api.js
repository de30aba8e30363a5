// The service's part that the page uses, as functions. Nothing else in the page calls fetch.
// Addresses are relative, so that the page also works below a prefix, behind a proxy.
import { readFrame } from "./frame.js";
import { authorization, newToken } from "./token.js";

const [unauthorized, too_early, too_many] = [401, 409, 429];
// A PPM takes no time to pack and unpack; a picture with a transparent background is a PNG.
const frame_types = "image/x-portable-pixmap, image/png;q=0.5";
const most_attempts = 6;
const longest_wait_s = 60;  // nobody watches a page for longer

/// An answer that is not the one asked for, in the terms of RFC 9457.
export class Problem extends Error {
  /// status 0: there was no answer at all.
  constructor({ status = 0, title, detail = "", errors = [], retryAfter = null }) {
    super(title);
    Object.assign(this, { status, title, detail, errors, retryAfter });
  }
}

/// [{name, title, description, width, height}], in the server's order.
export async function listScenes() {
  return ask("scenes", {}, async (answer) => (await answer.json()).scenes);
}

/// The document of a shipped scene, as text.
export async function sceneText(name, signal) {
  return ask(`scenes/${encodeURIComponent(name)}`, { signal }, (answer) => answer.text());
}

/// Keeps a document at the server; the name by which `scene=` then finds it.
export async function keepScene(text) {
  return ask("scenes", posted(text), async (answer) => {
    await answer.text();  // unread, it would hold the connection
    return answer.headers.get("Location").split("/").pop();
  });
}

/// Renders `what`: {query} names a scene of the server's, {query, body} is a document.
/// Returns the PNG and what its headers say; rejects with a Problem, or AbortError by `signal`.
export async function render(what, signal) {
  // The browser's own store would give the times of a former answer for those of this one; and
  // without a word about it, a browser that is to use no store asks the server to use none either.
  const request = { ...requestOf(what, "image/png", signal), cache: "no-store" };
  request.headers["Cache-Control"] = "max-age=0";
  return ask(`render?${new URLSearchParams(what.query)}`, request, rendering);
}

/// A render as ImageData.
export async function renderFrame(what, signal) {
  const address = `render?${new URLSearchParams(what.query)}`;
  return ask(address, requestOf(what, frame_types, signal), readFrame);
}

/// What the engine chose for `what` and why, and the time and error to expect.
export async function plan(what, signal) {
  const request = { method: "POST", ...requestOf(what, "application/json", signal) };
  return ask(`plan?${new URLSearchParams(what.query)}`, request, (answer) => answer.json());
}

/// Starts a job of that task on `what`; its id. `signal` ends waiting for a busy server, and not what
/// the server has been asked: nobody could end a job whose id is not known.
export async function startJob(task, what, signal) {
  const request = { method: "POST", ...requestOf(what, "application/json") };
  const id = async (answer) => (await answer.json()).id;
  return ask(`jobs?${new URLSearchParams({ task, ...what.query })}`, request, id, signal);
}

/// {status, progress, detail, ...} of a job.
export async function jobState(id, signal) {
  return ask(`jobs/${id}`, { signal }, (answer) => answer.json());
}

/// The picture of a job that is done, as render() gives it.
export async function jobImage(id, signal) {
  return ask(`jobs/${id}/image`, { signal, headers: { Accept: "image/png" } }, rendering);
}

/// ImageData of the picture as far as it has come; null if there is none at this moment.
export async function jobFrame(id, signal) {
  try {
    return await ask(`jobs/${id}/image`, { signal, headers: { Accept: frame_types } }, readFrame);
  } catch (error) {
    if (error.status === too_early) return null;
    throw error;
  }
}

export async function jobResult(id, signal) {
  return ask(`jobs/${id}/result`, { signal }, (answer) => answer.json());
}

/// `onEvent(name, job)` for each event of a job until it has ended, or they do.
export async function jobEvents(id, signal, onEvent) {
  await askOnce(`jobs/${id}/events`, { signal, headers: authorization() }, async ({ body }) => {
    const reader = body.pipeThrough(new TextDecoderStream()).getReader();
    for (let text = ""; ;) {
      const { value, done } = await reader.read();
      if (done) return;
      const events = (text + value).split("\n\n");
      text = events.pop();
      for (const event of events) {
        const said = /^event: (.+)\ndata: (.+)$/.exec(event);
        if (said) onEvent(said[1], JSON.parse(said[2]));
      }
    }
  });
}

/// Also for when the page is being left; whether it succeeds is nobody's business then.
export function cancelJob(id) {
  fetch(`jobs/${id}`, { method: "DELETE", headers: authorization(), keepalive: true }).catch(() => {});
}

async function rendering(answer) {
  if (!answer.headers.get("Content-Type")?.startsWith("image/")) throw new Error("no image");
  const timing = answer.headers.get("Server-Timing") ?? "";
  return {
    blob: await answer.blob(),
    samples: answer.headers.get("Render-Samples"),
    precision: answer.headers.get("Render-Precision"),
    error: answer.headers.get("Render-Error"),
    stop: answer.headers.get("Render-Stop"),
    tasks: answer.headers.get("Render-Tasks"),  // null: rendered where it arrived
    workers: answer.headers.get("Render-Workers"),
    cache: /\bcache;desc=(\w+)/.exec(timing)?.[1] ?? null,  // "hit", "shared" with another request; null: neither
    stages: stagesOf(timing),
  };
}

function requestOf({ body }, accept, signal) {
  const request = body === undefined ? { signal, headers: {} } : posted(body, signal);
  request.headers.Accept = accept;
  return request;
}

function posted(body, signal) {
  return { method: "POST", headers: { "Content-Type": "application/json" }, body, signal };
}

/// Server-Timing's value ("parse;dur=0.3, trace;dur=120") as [{name, ms}], in its order.
export function stagesOf(header) {
  const stages = [];
  for (const metric of header.split(",")) {
    const [name, ...parameters] = metric.split(";").map((part) => part.trim());
    const duration = parameters.find((parameter) => parameter.startsWith("dur="));
    if (name && duration) stages.push({ name, ms: Number(duration.slice(4)) });
  }
  return stages;
}

// Asks for a token where the server wants one, and again if it was none of its. Where the server has
// too much to do, it says for how long: after that it is asked again, until `signal` ends it.
async function ask(address, { headers, ...request }, read, signal = request.signal) {
  for (let attempt = 1; ; attempt += 1) {
    const proof = authorization();
    try {
      return await askOnce(address, { ...request, headers: { ...headers, ...proof } }, read);
    } catch (error) {
      const wait_s = Number(error.retryAfter);
      if (error.status === too_many && wait_s > 0 && wait_s <= longest_wait_s && attempt < most_attempts) await waitFor(wait_s, signal);
      else if (error.status !== unauthorized) throw error;
      else if (!(await newToken(proof, signal)))
        throw new Problem({ title: "This server asks for a token", detail: "Press Render to give it." });
    }
  }
}

// The document hears of it as "busy": {detail: seconds}, and 0 when it is over.
async function waitFor(seconds, signal) {
  signal?.throwIfAborted();
  const tell = (detail) => document.dispatchEvent(new CustomEvent("busy", { detail }));
  tell(seconds);
  try {
    await new Promise((resolve, reject) => {
      setTimeout(resolve, seconds * 1000);
      signal?.addEventListener("abort", () => reject(signal.reason), { once: true });
    });
  } finally {
    tell(0);
  }
}

async function askOnce(address, request, read) {
  const unlessKnown = (error, problem) => (error instanceof Problem || error.name === "AbortError" ? error : new Problem(problem));
  const answer = await fetch(address, request).catch((error) => {
    throw unlessKnown(error, {
      title: "The server does not answer",
      detail: `Is raytracer-server still running at ${location.host}? (${error.message})`,
    });
  });
  if (!answer.ok) throw await problemOf(answer);
  try {
    return await read(answer);
  } catch (error) {
    throw unlessKnown(error, {
      status: answer.status,
      title: "The answer cannot be read",
      detail: `It broke off, or something else than raytracer-server at ${location.host} answered. (${error.message})`,
    });
  }
}

async function problemOf(answer) {
  const { status } = answer;
  const retryAfter = answer.headers.get("Retry-After");
  // What stands between this page and the server may answer with something else than JSON.
  const { title, detail, errors } = await answer.json().catch(() => ({}));
  return new Problem({ status, title: title ?? `The server answered ${status}`, detail, errors, retryAfter });
}
