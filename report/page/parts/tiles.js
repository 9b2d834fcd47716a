// The few figures that a reader looks for first.
import { element } from "../base/elements.js";
import { duration, fixed, isNumber, millimetres, number } from "../base/numbers.js";
import { allRegions } from "./groups.js";

function tile(what, value, more) {
  return element(
    "div",
    { class: "tile" },
    element("div", { class: "what" }, what),
    element("div", { class: "value" }, value),
    element("div", { class: "more" }, more || ""),
  );
}

const change = (before, after) => (after ? [before, element("span", { class: "to" }, "→"), after] : [before]);

/** Of each run the whole wall in the first source. */
function wholes(report, kind) {
  const all = report.runs.map((run) => ({
    run,
    group: run.comparison.sources.length ? run.comparison.sources[0][kind].all_frames.find(allRegions) : null,
  }));
  return all.filter((whole) => whole.group && isNumber(whole.group.l2));
}

function distanceTile(report, kind, name) {
  const found = wholes(report, kind).slice(0, 2);
  if (!found.length) return null;
  const [before, after] = found.map((w) => millimetres(w.run.mm * w.group.l2));
  const sigmas = found.filter((w) => w.group.in_noise).map((w) => fixed(w.group.in_noise.l2, 1));
  const forced = found.length > 1 && found[1].run.forced ? ", with the missing force" : "";
  return tile(
    name,
    [...change(before, after), " mm"],
    sigmas.length ? `${sigmas.join(" → ")} σ of noise${forced}` : "",
  );
}

function motionTile(report) {
  const own = wholes(report, "training")[0];
  if (!own || !own.group.apparent || !isNumber(own.group.apparent.l2)) return null;
  return tile("Motion in the images", `${millimetres(own.run.mm * own.group.apparent.l2)} mm`, "the yardstick");
}

function candidatesTile(diagnosis) {
  if (!diagnosis || !diagnosis.effects) return null;
  const data = diagnosis.independent_data;
  const on = isNumber(data) ? `on ${number(data, 3)} independent data` : "";
  return tile("Candidates tried", String(diagnosis.effects.length), on);
}

/** Runs of the model that the diagnoses looked at. */
export const runsOf = (report) => report.diagnoses.reduce((sum, d) => sum + (d.diagnosis.cost?.runs || 0), 0);

/** CPU of the whole path; of a diagnosis alone that of its runs. */
export const costOf = (report) => (report.explain ? report.explain.cost : report.diagnoses[0]?.diagnosis.cost) || null;

function costTile(report) {
  const runs = runsOf(report),
    cost = costOf(report);
  if (!runs) return null;
  return tile(
    "Runs of the model",
    String(runs),
    isNumber(cost?.cpu_seconds) ? `${duration(cost.cpu_seconds)} of CPU` : "",
  );
}

export function tiles(report) {
  const all = [
    distanceTile(report, "held_out", "Distance, held-out frames"),
    distanceTile(report, "training", "Distance, training frames"),
    motionTile(report),
    candidatesTile(report.diagnoses[0]?.diagnosis),
    costTile(report),
  ].filter(Boolean);
  return all.length > 1 ? element("div", { class: "tiles" }, all) : null;
}
