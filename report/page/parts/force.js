// The force that is missing where no effect explains what is left.
import { element, section } from "../base/elements.js";
import { isNumber, minus, number, percent, prose, unitText, words } from "../base/numbers.js";
import { bandChart } from "../charts/band_chart.js";

/** A term of a law: its coefficient, and what would do as well in its place. */
function termText({ term, coefficient, deviation, alike }) {
  const other = alike.length ? `, in whose place ${alike.map(words).join(" or ")} would do as well` : "";
  return `${words(term)}: ${number(coefficient)} ± ${number(deviation, 2)}${other}`;
}

function lawText(law) {
  return element(
    "p",
    { class: "note" },
    element("strong", {}, law.text ? minus(prose(law.text)) : "no simple law"),
    isNumber(law.r2) ? ` explains ${percent(law.r2)} of the force. ` : " ",
    law.terms.map(termText).join("; "),
  );
}

function forceChart({ time, value, lower, upper, unit }) {
  return bandChart({
    series: [{ time, value, lower, upper, colour: "var(--accent)" }],
    title: `force per area [${unitText(unit)}]`,
    marks: [{ value: 0, text: "" }],
  });
}

function regionForce(region) {
  return element(
    "div",
    {},
    element("h3", {}, words(region.region) || "whole wall"),
    forceChart(region),
    region.law ? lawText(region.law) : null,
  );
}

export function forceSection(report) {
  if (!report.force) return null;
  return section(
    "force",
    "The force that is missing",
    "No effect of the catalogue explains what is left. This is the force on each region of the wall that would, as the data ask for it, and the simplest law that follows it.",
    ...(report.force.sentences || []).map((s) => element("p", {}, prose(s))),
    element("div", { class: "pair" }, (report.force.regions || []).map(regionForce)),
  );
}
