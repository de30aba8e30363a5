// Signs of life of what takes long: seconds passing, and a way to end it.
import { passFocus } from "./focus.js";

const patience_ms = 200;  // what is shorter needs none
const worth_saying_ms = 1000;

/// `elapsed` says how long, `cancel` is a button; `neighbour` gets its focus when it goes.
export function createWaiting({ elapsed, cancel, neighbour }) {
  function hideCancel() {
    passFocus(cancel, neighbour);
    cancel.hidden = true;
  }

  return {
    hideCancel,

    /// Returns {passed_ms(), expect(ms), end()}. `onLong()` follows once the patience is over.
    begin(onLong) {
      const started_ms = performance.now();
      const passed_ms = () => performance.now() - started_ms;
      let expected = "";
      let isLong = false;
      elapsed.textContent = "";
      hideCancel();
      const clock = setInterval(() => {
        if (passed_ms() < patience_ms) return;
        if (!isLong) onLong();
        isLong = true;
        elapsed.textContent = `${(passed_ms() / 1000).toFixed(1)} s${expected}`;
        cancel.hidden = false;
      }, 100);
      return {
        passed_ms,
        expect(ms) {
          expected = ms > worth_saying_ms ? ` of ${Math.round(ms / 1000)} s` : "";
        },
        end: () => clearInterval(clock),
      };
    },

    /// Nothing is waited for.
    clear() {
      elapsed.textContent = "";
      hideCancel();
    },
  };
}
