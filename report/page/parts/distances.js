import { element, section, tabs } from "../base/elements.js";
import { isNumber, millimetres, words } from "../base/numbers.js";
import { legend } from "../charts/legend.js";
import { barChart } from "../charts/bar_chart.js";
import { distanceText, regionLabel, runColour, sameRegion } from "./groups.js";

function errorRows(sources, runs, kind) {
  return sources[0][kind].all_frames
    .filter((g) => isNumber(g.l2))
    .map((first) => {
      const bars = sources
        .map((source, i) => {
          const group = sameRegion(source[kind].all_frames, first);
          if (!group || !isNumber(group.l2)) return null;
          const mm = runs[i].mm;
          return {
            value: mm * group.l2,
            colour: runColour(i, runs.length),
            text: distanceText(group, mm),
            tip: `${regionLabel(group)}, ${runs[i].label}\nroot mean square ${distanceText(group, mm)}\nmean, signed ${distanceText(group, mm, "mean")}\n95 % of the wall below ${distanceText(group, mm, "p95")}\nlargest ${distanceText(group, mm, "linf")}\n${group.samples} places`,
          };
        })
        .filter(Boolean);
      const own = first.apparent && isNumber(first.apparent.l2) ? runs[0].mm * first.apparent.l2 : null;
      return {
        name: regionLabel(first),
        bars,
        mark:
          own === null
            ? null
            : {
                value: own,
                tip: `The vessel's own motion in these images: ${millimetres(own)} mm. A model that never moved would be off by this much.`,
              },
      };
    });
}

/** Before and after, per region, of training and held-out frames. */
function errorCharts(runs, index) {
  const sources = runs.map((run) => run.comparison.sources[index]);
  const kinds = [
    ["training", "Training frames"],
    ["held_out", "Held-out frames: nothing was fitted to them"],
  ];
  const shown = kinds
    .map(([kind, title]) => ({ kind, title, rows: errorRows(sources, runs, kind) }))
    .filter((k) => k.rows.length);
  if (!shown.some((k) => k.kind === "held_out")) shown[0].title = "All frames (none were held out)";
  const deviation = runs[0].mm * sources[0].noise.deviation;
  const largest = Math.max(
    ...shown.flatMap((k) => k.rows.flatMap((r) => [...r.bars.map((b) => b.value), r.mark ? r.mark.value : 0])),
    deviation,
  );
  const guide = deviation > 0 ? { value: deviation, text: "noise" } : null;
  const high = largest * 1.05;
  return element(
    "div",
    { class: "pair", style: shown.length < 2 ? "grid-template-columns:1fr" : null },
    shown.map((k) =>
      element(
        "div",
        {},
        element("h3", {}, k.title),
        barChart({ rows: k.rows, title: "root mean square distance [mm]", guide, high }),
      ),
    ),
  );
}

export function errorSection(runs) {
  const sources = runs[0].comparison.sources;
  if (!sources.length) return null;
  const keys = legend([
    ...runs.map((run, i) => ({ text: run.label, mark: "bar", colour: runColour(i, runs.length) })),
    { text: "motion of the vessel in the images (yardstick)", mark: "rule", colour: "var(--yardstick)" },
    sources.some((s) => s.noise.deviation > 0)
      ? { text: "noise of the measurement, 1 σ", mark: "dashed", colour: "var(--noise)" }
      : null,
  ]);
  return section(
    "errors",
    "How far the model is from the images",
    "Distance between the simulated and the imaged inner surface of the vessel, over all frames. A good model comes down to the noise; one whose bar reaches the yardstick explains nothing of the motion.",
    keys,
    ...tabs(sources.map((source, i) => ({ label: words(source.name), show: () => errorCharts(runs, i) }))),
  );
}
