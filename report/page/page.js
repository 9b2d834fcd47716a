"use strict";
// The page from top to bottom.

const verdictChips = {
  missing: ["Missing effect found", "bad"],
  nothing_missing: ["Nothing missing", "good"],
  ambiguous: ["Cannot tell which", "open"],
  not_in_catalogue: ["Not in the catalogue", "open"],
  undecided: ["Undecided", "open"],
};
/** What was found says what the chip says: an error of the data is no effect that the model lacks. */
function chipOf(verdict, first) {
  if (verdict === "missing" && first.startsWith("THE DATA")) return ["The data are off", "open"];
  if (verdict === "missing" && first.startsWith("THE NUMERICS")) return ["The numerics are too coarse", "open"];
  return verdictChips[verdict];
}
const kindNames = { explain: "explanation", comparison: "comparison", diagnosis: "diagnosis", estimate: "identification" };

/** Without the shouted first word, which the chip says. */
const plain = (sentence) => sentence.replace(/^(MISSING|NOTHING MISSING|NOT IN THE CATALOGUE|AMBIGUOUS|UNDECIDED): /, "").replace(/^.*$/s, prose).replace(/^[a-z]/, (c) => c.toUpperCase());

/** The first sentence large; the list of what cannot be told apart as a list. */
function headline(first, verdict) {
  const sentence = plain(first), alike = verdict === "ambiguous" ? sentence.match(/^(.*cannot tell) (.+)$/s) : null;
  const [one, ...beside] = alike ? alike[2].split("; ") : [""];
  const names = one.includes(", nor ") ? [] : one.split(" from ");
  if (names.length > 2) return [element("p", { class: "verdict" }, `${alike[1]} ${names.length} effects from each other`), furtherSentences(names.concat(beside))];
  return [element("p", { class: sentence.length > 110 ? "verdict long" : "verdict" }, sentence)];
}

/** What an identification says of itself, in sentences. */
function estimateSentences(estimate) {
  return estimate.parameters.map((p) => `${words(p.name)} is ${interval({ value: p.estimate.value, lower: p.estimate.lower_95, upper: p.estimate.upper_95, unit: p.unit })}`);
}

function tile(what, value, more, tip) {
  return element("div", { class: "tile", tip }, element("div", { class: "what" }, what), element("div", { class: "value" }, value), element("div", { class: "more" }, more || ""));
}

const change = (before, after) => (after === null ? [before] : [before, element("span", { class: "to" }, "→"), after]);

/** The few figures that a reader looks for first. */
function tiles(report) {
  const all = [];
  const wholes = (kind) => report.runs.map((run) => ({ run, group: run.comparison.sources.length ? run.comparison.sources[0][kind].all_frames.find(allRegions) : null })).filter((w) => w.group && isNumber(w.group.l2));
  for (const [kind, name] of [["held_out", "Distance, held-out frames"], ["training", "Distance, training frames"]]) {
    const found = wholes(kind).slice(0, 2);
    if (!found.length) continue;
    const texts = found.map((w) => millimetres(w.run.mm * w.group.l2)), sigmas = found.filter((w) => w.group.in_noise).map((w) => fixed(w.group.in_noise.l2, 1));
    all.push(tile(name, [change(texts[0], texts.length > 1 ? texts.at(-1) : null), " mm"].flat(), sigmas.length ? `${sigmas.join(" → ")} σ of noise${found.length > 1 && found[1].run.folder.startsWith("force") ? ", with the missing force" : ""}` : ""));
  }
  const own = wholes("training")[0];
  if (own && own.group.apparent && isNumber(own.group.apparent.l2)) all.push(tile("Motion in the images", `${millimetres(own.run.mm * own.group.apparent.l2)} mm`, "the yardstick"));
  const diagnosis = report.diagnoses.length ? report.diagnoses[0].diagnosis : null;
  if (diagnosis && diagnosis.effects) all.push(tile("Candidates tried", String(diagnosis.effects.length), isNumber(diagnosis.independent_data) ? `on ${number(diagnosis.independent_data, 3)} independent data` : ""));
  const cost = report.explain ? report.explain.cost : diagnosis ? diagnosis.cost : null;
  if (cost && isNumber(cost.runs)) all.push(tile("Runs of the model", String(cost.runs), isNumber(cost.cpu_seconds) ? `${duration(cost.cpu_seconds)} of CPU` : ""));
  return all.length > 1 ? element("div", { class: "tiles" }, all) : null;
}

const furtherSentences = (sentences) => (sentences.length ? element("ul", { class: "further" }, sentences.map((s) => element("li", {}, plain(s)))) : null);

function head(report) {
  const sentences = report.sentences.length ? report.sentences : report.estimates.length ? estimateSentences(report.estimates[0].estimate) : [];
  const [name, colour] = chipOf(report.verdict, sentences[0] || "") || [kindNames[report.kind] || report.kind, ""];
  return [
    element("h1", {}, report.title, element("span", { class: "kind" }, ` — ${kindNames[report.kind] || "results"} · ${report.case}`)),
    element("span", { class: `chip ${colour}` }, name),
    ...headline(sentences[0] || "Results", report.verdict),
    furtherSentences(sentences.slice(1, 5)),
    sentences.length > 5 ? element("details", {}, element("summary", {}, `${sentences.length - 5} more`), furtherSentences(sentences.slice(5))) : null,
    tiles(report),
  ].filter(Boolean);
}

function parts(report) {
  const runs = report.runs;
  return [
    runs.length ? () => errorSection(runs) : null,
    () => wallSection(report),
    runs.length ? () => heatSection(runs) : null,
    () => rankingSection(report),
    () => lookAlikeSection(report),
    () => detectableSection(report),
    () => modelsSection(report),
    () => estimateSection(report),
    () => forceSection(report),
    runs.length ? () => traceSection(runs) : null,
    () => provenanceSection(report),
    glossarySection,
  ].filter(Boolean);
}

/** A part that cannot be drawn does not take the others with it. */
function drawn(part) {
  try {
    return part();
  } catch (error) {
    const root = document.documentElement;
    root.dataset.errors = (root.dataset.errors ? root.dataset.errors + "\n" : "") + error.stack;
    return element("section", {}, element("p", { class: "note" }, `A part of this page could not be drawn: ${error.message}`));
  }
}

function start() {
  const report = JSON.parse(document.getElementById("data").textContent);
  for (const run of report.runs) run.label = words(run.label);
  document.getElementById("head").replaceChildren(...head(report));
  document.getElementById("parts").replaceChildren(...parts(report).map(drawn).filter(Boolean));
  document.getElementById("foot").replaceChildren(`Made by Tether ${report.made.version} on ${report.made.date}. All figures are those of the JSON files beside this page.`);
  showTips(document.getElementById("tip"));
  document.documentElement.dataset.state = "ready";
}

start();
