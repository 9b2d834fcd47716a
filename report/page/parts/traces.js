// Measurements other than those of the lumen: what is left of them, before and after.
import { element, section } from "../base/elements.js";
import { fixed, isNumber, number, unitText, withUnit, words } from "../base/numbers.js";

/** A value in the unit that people use, where there is one: "1.1 mmHg". */
function clinical(run, value, symbol) {
  const known = run.clinical[symbol];
  return known ? `${number(known.factor * value)} ${known.unit}` : withUnit(number(value), unitText(symbol));
}

/** What is left of one measurement in one run; left: {l2, in_noise}. */
function leftCell(run, left, unit) {
  const text = left && isNumber(left.l2) ? clinical(run, left.l2, unit) : "–";
  const sigma = left && left.in_noise ? element("div", { class: "minor" }, `${fixed(left.in_noise.l2, 1)} σ`) : null;
  return element("td", { class: "number" }, text, sigma);
}

function row({ name, unit, held_out }, comparedWith, cells) {
  const note = held_out === true ? element("div", { class: "minor" }, "held out") : null;
  const title = element("td", {}, element("span", { class: "name" }, words(name)), note);
  return element("tr", {}, title, element("td", {}, comparedWith), cells(unit));
}

/** Rows of `list` in comparison.json; leftOf(entry): what is left of it, comparedWith(entry): with what. */
function rowsOf(runs, list, comparedWith, leftOf) {
  return (runs[0].comparison[list] || []).map((entry, k) =>
    row(entry, comparedWith(entry), (unit) => runs.map((run) => leftCell(run, leftOf(run.comparison[list][k]), unit))),
  );
}

function table(runs, rows) {
  const heads = ["measurement", "compared with"].map((text) => element("th", {}, text));
  const labels = runs.map((run) => element("th", { class: "number" }, run.label));
  const head = element("thead", {}, element("tr", {}, heads, labels));
  return element("div", { class: "scroll" }, element("table", {}, head, element("tbody", {}, rows)));
}

export function traceSection(runs) {
  const rows = [
    ...rowsOf(
      runs,
      "traces",
      (trace) => trace.observable,
      (trace) => trace,
    ),
    ...rowsOf(
      runs,
      "velocities",
      () => "velocity",
      (velocity) => velocity?.training,
    ),
    ...rowsOf(
      runs,
      "others",
      (other) => words(other.kind),
      (other) => other?.training,
    ),
  ];
  if (!rows.length) return null;
  return section(
    "traces",
    "Pressures, flows, velocities",
    "Root mean square difference between the run and what was measured, in its unit and in units of its noise.",
    table(runs, rows),
  );
}
