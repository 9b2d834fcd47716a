// Verdict, sentences and figures at the top.
import { element } from "../base/elements.js";
import { interval, words } from "../base/numbers.js";
import { tiles } from "./tiles.js";
import { chipOf, furtherSentences, headline } from "./verdict.js";

const kindNames = {
  explain: "explanation",
  comparison: "comparison",
  diagnosis: "diagnosis",
  estimate: "identification",
  simulation: "simulation",
};

/** What an identification says of itself, in sentences. */
function estimateSentences(estimate) {
  return estimate.parameters.map(({ name, unit, estimate: { value, lower_95, upper_95 } }) => {
    return `${words(name)} is ${interval({ value, lower: lower_95, upper: upper_95, unit })}`;
  });
}

function sentencesOf(report) {
  if (report.sentences.length) return report.sentences;
  return report.estimates.length ? estimateSentences(report.estimates[0].estimate) : [];
}

function folded(title, sentences) {
  if (!sentences.length) return null;
  return element("details", {}, element("summary", {}, title), furtherSentences(sentences));
}

/** Of a run alone or an identification they are few, and what one must know before one believes it. */
function remarks(report) {
  const title =
    report.remarks.length === 1 ? "1 remark of the programs" : `${report.remarks.length} remarks of the programs`;
  const part = folded(title, report.remarks);
  if (part && !report.runs.length) part.open = true;
  return part;
}

export function head(report) {
  const sentences = sentencesOf(report);
  const { chip, colour } = chipOf(report) || { chip: kindNames[report.kind] || report.kind, colour: "" };
  const kind = element("span", { class: "kind" }, ` — ${kindNames[report.kind] || "results"} · ${report.case}`);
  return [
    element("h1", {}, report.title, kind),
    element("span", { class: `chip ${colour}` }, chip),
    ...headline(report, sentences[0] || "Results"),
    furtherSentences(sentences.slice(1, 5)),
    folded(`${sentences.length - 5} more`, sentences.slice(5)),
    ...report.warnings.map((warning) => element("p", { class: "warning" }, warning)),
    remarks(report),
    tiles(report),
  ].filter(Boolean);
}
