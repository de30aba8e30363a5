// Signs of life of what takes long: seconds passing, and a way to end it.

const patience_ms = 200;  // what is shorter needs none

/// Returns {passed_ms(), end()}. `onLong()` follows at each tick after the patience.
export function startWaiting(elapsed, cancel, onLong) {
  const started_ms = performance.now();
  const passed_ms = () => performance.now() - started_ms;
  elapsed.textContent = "";
  cancel.hidden = true;
  const clock = setInterval(() => {
    if (passed_ms() < patience_ms) return;
    onLong();
    elapsed.textContent = `${(passed_ms() / 1000).toFixed(1)} s`;
    cancel.hidden = false;
  }, 100);
  return { passed_ms, end: () => clearInterval(clock) };
}
