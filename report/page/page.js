// The page from top to bottom; every other module is drawn from here.
import { noteFailure } from "./base/failures.js";
import { element } from "./base/elements.js";
import { words } from "./base/numbers.js";
import { showTips } from "./base/tips.js";
import { detectableSection } from "./parts/detectable.js";
import { errorSection } from "./parts/distances.js";
import { glossarySection } from "./parts/glossary.js";
import { head } from "./parts/head.js";
import { heatSection } from "./parts/heat.js";
import { lookAlikeSection } from "./parts/look_alikes.js";
import { estimateSection } from "./parts/estimates.js";
import { forceSection } from "./parts/force.js";
import { modelsSection } from "./parts/path.js";
import { misfitSection, plotSection } from "./parts/plots.js";
import { provenanceSection } from "./parts/provenance.js";
import { publishedSection } from "./parts/published.js";
import { rankingSection } from "./parts/ranking.js";
import { tableSection } from "./parts/table.js";
import { traceSection } from "./parts/traces.js";
import { wallSection } from "./wall/section.js";

function parts(report) {
  const runs = report.runs;
  return [
    () => plotSection(report),
    runs.length ? () => errorSection(runs) : null,
    () => wallSection(report),
    runs.length ? () => heatSection(runs) : null,
    () => tableSection(report),
    () => publishedSection(report),
    () => rankingSection(report),
    () => lookAlikeSection(report),
    () => misfitSection(report),
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
    noteFailure(error.stack);
    return element(
      "section",
      {},
      element("p", { class: "note" }, `A part of this page could not be drawn: ${error.message}`),
    );
  }
}

function start() {
  const report = JSON.parse(document.getElementById("data").textContent);
  for (const run of report.runs) run.label = words(run.label);
  document.getElementById("head").replaceChildren(...head(report));
  document.getElementById("parts").replaceChildren(...parts(report).map(drawn).filter(Boolean));
  document
    .getElementById("foot")
    .replaceChildren(
      `Made by Tether ${report.made.version} on ${report.made.date}. All figures are those of the JSON files beside this page.`,
    );
  showTips(document.getElementById("tip"));
  document.documentElement.dataset.state = "ready";
}

start();
