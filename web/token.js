// The token of a server that asks for one: from a dialog, kept for this tab alone.
import { keptInTab, keepInTab } from "./tab_memory.js";

let token = keptInTab("token");
let asking = null;  // the promise of a dialog that is open

const headersWith = (given) => (given ? { Authorization: `Bearer ${given}` } : {});

/// The headers that prove that the person may ask.
export const authorization = () => headersWith(token);

/// Whether there is another token now than that of the headers `refused`; asks for one if not.
/// Rejects if `signal` ends it first; the dialog stays for the other requests that wait for it.
export async function newToken(refused, signal) {
  if (refused.Authorization !== authorization().Authorization) return true;
  asking ??= ask(token !== null).finally(() => {
    asking = null;
  });
  const isGiven = await asking;
  signal?.throwIfAborted();
  return isGiven;
}

function ask(wasWrong) {
  const dialog = document.querySelector("#token-dialog");
  const input = dialog.querySelector("input");
  dialog.querySelector("[role=alert]").textContent = wasWrong ? "That is not this server's token." : "";
  input.value = "";
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener("close", () => {
      if (dialog.returnValue === "given") keepInTab("token", token = input.value.trim());
      resolve(dialog.returnValue === "given");
    }, { once: true });
  });
}
