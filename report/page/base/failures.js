// What went wrong in the page's scripts, for tests to see: the attribute data-errors of the page.

export function noteFailure(what) {
  const { dataset } = document.documentElement;
  dataset.errors = (dataset.errors ? dataset.errors + "\n" : "") + what;
}

window.addEventListener("error", (event) => noteFailure(event.message));
