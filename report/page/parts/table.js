// How probable each explanation is: the table that sums to one, and what stands behind each of its lines.
import { element, section, tabs } from "../base/elements.js";
import { effectName } from "../base/names.js";
import { isNumber, number, percent, unitText, withUnit } from "../base/numbers.js";

const bar = (share, colour) =>
  element(
    "span",
    { class: "track" },
    element("span", { class: "fill", style: `width:${(100 * share).toFixed(1)}%;background:${colour}` }),
  );

const chance = (p) => (p > 0.995 ? "> 99 %" : p < 0.005 ? "< 1 %" : percent(p));

function line(name, p, colour, note) {
  return element(
    "tr",
    {},
    element("td", { class: "what" }, name, note ? element("div", { class: "minor" }, note) : null),
    element("td", { class: "bar" }, bar(p, colour)),
    element("td", { class: "number" }, chance(p)),
  );
}

const groupName = (group) =>
  effectName(group.members[0]) + (group.members.length > 1 ? ", or what does much the same" : "");

function memberNote(member) {
  const value = isNumber(member.value)
    ? ` at about ${withUnit(number(member.value, 2), unitText(member.unit))}${member.by_runs ? "" : ", to first order"}`
    : "";
  return `${effectName(member)} ${chance(member.share)}${value}`;
}

/** Combinations, with what is improbable by itself taken together: "A", "A and something else beside". */
function merged(table) {
  const likely = (g) => table.groups[g].probability >= 0.5;
  const lines = new Map();
  for (const { groups, probability } of table.combinations) {
    const core = groups.some(likely) ? groups.filter(likely) : groups;
    const beside = core.length < groups.length;
    const key = `${core} ${beside}`;
    if (!lines.has(key)) lines.set(key, { core, beside, probability: 0 });
    lines.get(key).probability += probability;
  }
  return [...lines.values()].sort((a, b) => b.probability - a.probability);
}

const shares = (table, groups) =>
  groups
    .map((g) => table.groups[g].members)
    .filter((members) => members.length > 1)
    .map((members) => members.map(memberNote).join("; "))
    .join(" — ");

const lineOf = (table, { core, beside, probability }) =>
  line(
    core.map((g) => groupName(table.groups[g])).join(" and ") + (beside ? ", and something else beside" : ""),
    probability,
    "var(--bad)",
    beside ? "" : shares(table, core),
  );

/** How much the name of what leads depends on what is assumed: of what is no mesh or step, if any is there. None where
 * nothing leads. */
function certainty(table) {
  const isOfModel = (group) => group.members[0].kind !== "numerics" && group.probability >= 0.5;
  const first = table.groups.find(isOfModel) || table.groups[0];
  if (!first || first.probability < 0.5 || !table.otherwise.length) return null;
  return element(
    "p",
    { class: "minor" },
    `With noise 30 % smaller or larger, effects half or twice as large, or the model's own error half or twice as large, the chance of ${groupName(first)} is ${chance(first.least_probability)} at least.`,
  );
}

function drawn(table) {
  const lines = merged(table),
    few = lines.filter((one) => one.probability < 0.01).reduce((sum, one) => sum + one.probability, 0);
  const drawnLines = element(
    "table",
    { class: "chances" },
    ...lines.filter((one) => one.probability >= 0.01).map((one) => lineOf(table, one)),
    line("Nothing is missing", table.nothing, "var(--good)"),
    line("Something that the catalogue does not have", table.outside, "var(--yardstick)"),
    table.others + few >= 0.005 ? line("Anything else", table.others + few, "var(--faint)") : null,
  );
  return element("div", {}, drawnLines, certainty(table));
}

export function tableSection(report) {
  const weighed = report.diagnoses.filter(
    (d) =>
      d.diagnosis.table &&
      d.diagnosis.table.nothing + d.diagnosis.table.outside + d.diagnosis.table.combinations.length > 0,
  );
  if (!weighed.length) return null;
  return section(
    "chances",
    "How sure that is",
    "How probable each explanation is, given all measurements and what was known before: the lines add up to 100 %. An explanation is named if its lines add up to 95 %. Where several do much the same to the measurements they share a line; their shares are of that line.",
    ...tabs(weighed.map((d) => ({ label: d.label || "candidates", show: () => drawn(d.diagnosis.table) }))),
  );
}
