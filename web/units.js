// Numbers as people read them.

/// 0.31 -> "0.31 ms", 118.2 -> "118 ms", 2412 -> "2.41 s".
export function duration(ms) {
  if (ms > 0 && ms < 0.005) return "< 0.01 ms";
  const seconds = Math.round(ms / 1000);
  if (seconds >= 60) return `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
  return ms >= 999.5 ? `${digits(ms / 1000)} s` : `${digits(ms)} ms`;
}

/// 48213 -> "48.2 kB".
export function bytes(count) {
  if (count < 1000) return `${count} B`;
  return count < 999_500 ? `${digits(count / 1000)} kB` : `${digits(count / 1e6)} MB`;
}

/// "1 error", "2 errors".
export function pluralised(count, noun) {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

/// Three digits where there are as many, and never more than two decimals.
export function digits(value) {
  const decimals = value >= 100 ? 0 : value >= 10 ? 1 : 2;
  return String(Number(value.toFixed(decimals)));
}
