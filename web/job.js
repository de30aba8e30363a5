// A job of the server's from its start to its end: followed by its events, or where none come, by
// asking again and again.
import { cancelJob, jobEvents, jobState, Problem, startJob } from "./api.js";

const look_again_ms = 250;
const ends = ["done", "failed", "cancelled"];

/// Starts a job of that task on `what` (see api.js) and gives what `work(id)` gives once it is done;
/// `onProgress(job)` comes before, whenever there is news. Rejects with a Problem, or AbortError by
/// `signal`. However this ends, and if the page is left, the server ends and forgets the job.
export async function withJob(task, what, signal, onProgress, work) {
  const id = await startJob(task, what, signal);
  const leave = () => cancelJob(id);
  window.addEventListener("pagehide", leave);
  try {
    signal.throwIfAborted();
    const job = (await told(id, signal, onProgress)) ?? (await asked(id, signal, onProgress));
    if (job.status !== "done") throw new Problem({ title: `The job ${job.status === "failed" ? "failed" : "was cancelled"}`, detail: job.detail });
    return await work(id);
  } finally {
    window.removeEventListener("pagehide", leave);
    leave();
  }
}

// The job when it has ended; null if its events cannot be had or end before it.
async function told(id, signal, onProgress) {
  let ended = null;
  try {
    await jobEvents(id, signal, (name, job) => {
      if (ends.includes(name)) ended = job;
      else onProgress(job);
    });
  } catch (error) {
    if (signal.aborted) throw error;
  }
  return ended;
}

async function asked(id, signal, onProgress) {
  for (;;) {
    const job = await jobState(id, signal);
    if (ends.includes(job.status)) return job;
    onProgress(job);
    await new Promise((wake) => setTimeout(wake, look_again_ms));
    signal.throwIfAborted();
  }
}
