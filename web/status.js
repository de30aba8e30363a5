// What the page is doing, in words and, for style sheets and tests, in data-state of the root.

/// `line` says it: until the next state, what is said in between; that the server is busy, as long as
/// it is.
export function createStatus(line) {
  const root = document.documentElement;
  let said = "";  // of the state

  document.addEventListener("busy", ({ detail: seconds }) => {
    line.textContent = seconds > 0 ? `The server is busy: again in ${seconds} s` : said;
  });

  return {
    get state() {
      return root.dataset.state;
    },
    enter(state, words) {
      root.dataset.state = state;
      line.textContent = said = words;
    },
    say(words) {
      line.textContent = words;
    },
  };
}
