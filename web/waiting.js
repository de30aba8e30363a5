// Signs of life of what takes long: seconds passing, and a way to end it.

const patience_ms = 200;  // what is shorter needs none
const worth_saying_ms = 1000;

/// Returns {passed_ms(), expect(ms), end()}. `onLong()` follows once the patience is over.
export function startWaiting(elapsed, cancel, onLong) {
  const started_ms = performance.now();
  const passed_ms = () => performance.now() - started_ms;
  let expected = "";
  let isLong = false;
  elapsed.textContent = "";
  cancel.hidden = true;
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
}
