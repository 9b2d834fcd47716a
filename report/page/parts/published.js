// What the accepted effects change in quantities that are published of vessels, beside what their rivals would.
import { element, section, tabs } from "../base/elements.js";
import { isNumber, number, prose } from "../base/numbers.js";

const most = 5; // models side by side

const roles = { as_it_is: "model as it is", accepted: "with what was found", rival: "with a rival" };

const nameOf = ({ quantity, where, unit }) =>
  `${quantity.replaceAll("_", " ")}${where ? ` at ${where}` : ""} [${prose(unit)}]`;

const valueOf = ({ value, lower, upper }) =>
  isNumber(lower) && isNumber(upper)
    ? [number(value, 3), element("div", { class: "minor" }, `${number(lower, 3)} to ${number(upper, 3)}`)]
    : [number(value, 3)];

const heading = ({ model, effects }) =>
  element("th", {}, roles[model], element("div", { class: "minor" }, prose(effects.join("; "))));

function drawn(all) {
  const models = all.slice(0, most),
    more = all.length - models.length;
  const rows = models[0].quantities.map((quantity, i) =>
    element(
      "tr",
      {},
      element("td", { class: "what" }, nameOf(quantity)),
      ...models.map((model) => element("td", { class: "number" }, ...valueOf(model.quantities[i]))),
    ),
  );
  const table = element(
    "table",
    { class: "published" },
    element("tr", {}, element("th", {}, ""), ...models.map(heading)),
    ...rows,
  );
  const rest = more ? element("p", { class: "minor" }, `${more} more rivals in diagnosis.json: published.`) : null;
  return element("div", {}, table, rest);
}

export function publishedSection(report) {
  const changed = report.diagnoses.filter((d) => Array.isArray(d.diagnosis.published) && d.diagnosis.published.length);
  if (!changed.length) return null;
  return section(
    "published",
    "What it changes",
    "Quantities that are published of vessels, in the last beat of the model as it is, of the model with what was found, and with each rival in its place, which these data cannot exclude; below each its 95 % interval, from that of the effect. Pulse-wave velocity and distensibility are those of the whole lumen (Bramwell and Hill).",
    ...tabs(changed.map((d) => ({ label: d.label || "candidates", show: () => drawn(d.diagnosis.published) }))),
  );
}
