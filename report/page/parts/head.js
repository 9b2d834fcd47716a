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

function moreSentences(sentences) {
  if (!sentences.length) return null;
  return element("details", {}, element("summary", {}, `${sentences.length} more`), furtherSentences(sentences));
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
    moreSentences(sentences.slice(5)),
    ...report.warnings.map((warning) => element("p", { class: "warning" }, warning)),
    tiles(report),
  ].filter(Boolean);
}
