import { element, section, tabs } from "../base/elements.js";
import { interval, isNumber, number, unitText, words } from "../base/numbers.js";
import { bandChart } from "../charts/band_chart.js";

/** One parameter of an identification over time. */
function parameterChart(parameter, overTime) {
  const logarithmic = String(parameter.transform).startsWith("log");
  const over = overTime.parameters[parameter.name];
  const e = parameter.estimate;
  return element(
    "div",
    {},
    element("h3", {}, words(parameter.name)),
    element(
      "p",
      { class: "minor" },
      `${interval({ value: e.value, lower: e.lower_95, upper: e.upper_95, unit: parameter.unit })}. Before the data: ${number(parameter.prior.value)} (${number(parameter.prior.lower_95)} … ${number(parameter.prior.upper_95)}).`,
    ),
    bandChart({
      series: [
        { time: overTime.time, value: over.value, lower: over.lower, upper: over.upper, colour: "var(--accent)" },
      ],
      title: `${words(parameter.name)}${parameter.unit && parameter.unit !== "1" ? ` [${unitText(parameter.unit)}]` : ""}`,
      logarithmic,
      marks: [{ value: parameter.prior.value, text: "before the data" }],
    }),
  );
}

function estimateView(one) {
  const shown = one.over_time ? one.estimate.parameters.map((p) => parameterChart(p, one.over_time)) : [];
  const ratio = one.estimate.innovations ? one.estimate.innovations.chi_square_per_datum : null;
  return element(
    "div",
    {},
    element("div", { class: shown.length > 1 ? "pair" : "" }, shown),
    isNumber(ratio)
      ? element(
          "p",
          { class: "note" },
          `What is left of the misfit is ${number(ratio, 2)} times what the stated noise explains${ratio > 1.5 ? ": something else is missing, and the intervals are too narrow" : ratio < 0.5 ? ": the noise is stated too large" : ""}.`,
        )
      : null,
  );
}

export function estimateSection(report) {
  if (!report.estimates.length) return null;
  return section(
    "parameters",
    "Parameters over time",
    "How the estimate and its 95 % band develop as the frames of the beat come in. A band that does not become narrower means that the data did not tell.",
    ...tabs(report.estimates.map((one) => ({ label: one.label || "estimate", show: () => estimateView(one) }))),
  );
}
