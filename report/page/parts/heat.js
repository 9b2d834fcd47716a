import { element, section, tabs } from "../base/elements.js";
import { isNumber, number, signed, words } from "../base/numbers.js";
import { niceAbove } from "../charts/axes.js";
import { legend } from "../charts/legend.js";
import { colourBar } from "../charts/colour_bar.js";
import { heatMap } from "../charts/heat_map.js";
import { distanceText } from "./groups.js";

/** Mean signed distance per region and moment, in the noise's deviation, or in mm where no noise is stated. */
function heatTable(source, mm) {
  const regions = [...new Set(source.moments.flatMap((m) => m.groups.map((g) => g.region)))].sort(
    (a, b) => (a === null) - (b === null),
  );
  const inNoise = source.noise.deviation > 0;
  const values = regions.map((region) =>
    source.moments.map((moment) => {
      const group = moment.groups.find((g) => g.region === region);
      if (!group || !isNumber(group.mean)) return null;
      const value = inNoise ? group.in_noise.mean : mm * group.mean;
      const z = isNumber(group.z) ? `\nsignificance z = ${signed(group.z, 1)}` : "";
      return {
        value,
        text: signed(value, 1),
        tip: `${region === null ? "whole wall" : words(region)}, ${number(moment.time)} s${moment.held_out ? ", held out" : ""}\nmean ${signed(mm * group.mean, 2)} mm${inNoise ? ` = ${signed(value, 1)} σ` : ""}: data ${value > 0 ? "outside" : "inside"} the model\nroot mean square ${distanceText(group, mm)}${z}`,
      };
    }),
  );
  return { rows: regions.map((r) => (r === null ? "whole wall" : words(r))), values, inNoise };
}

function heatMaps(runs, index) {
  const tables = runs.map((run) => heatTable(run.comparison.sources[index], run.mm));
  const range = niceAbove(Math.max(...tables.flatMap((t) => t.values.flat().map((v) => (v ? Math.abs(v.value) : 0)))));
  const unit = tables[0].inNoise ? "σ" : "mm";
  const maps = runs.map((run, i) => {
    const moments = run.comparison.sources[index].moments;
    return element(
      "div",
      {},
      element("h3", {}, run.label),
      heatMap({
        ...tables[i],
        columns: moments.map((m) => number(m.time)),
        range,
        axis: i + 1 === runs.length ? "time [s]" : null,
        marked: moments.map((m) => m.held_out),
      }),
    );
  });
  return element(
    "div",
    {},
    element("div", { class: "lines" }, maps),
    element("div", { class: "scale" }, colourBar(range, unit, "data inside the model", "data outside the model")),
    runs[0].comparison.sources[index].moments.some((m) => m.held_out)
      ? legend([{ text: "held-out frame", mark: "ring", colour: "var(--soft)" }])
      : null,
  );
}

export function heatSection(runs) {
  const sources = runs[0].comparison.sources.filter((s) => s.moments.length);
  if (!sources.length) return null;
  return section(
    "heat",
    "Where and when",
    `Mean signed distance of each region at each frame${sources[0].noise.deviation > 0 ? ", in units of the measurement's noise (σ)" : ", in mm"}. Red: the data lie outside the model, which is too far inward there. Blue: the model is too far outward.`,
    ...tabs(
      sources.map((source) => ({
        label: words(source.name),
        show: () => heatMaps(runs, runs[0].comparison.sources.indexOf(source)),
      })),
    ),
  );
}
