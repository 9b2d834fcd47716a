"use strict";
// How far model and data are apart: per region over all frames, and per region and moment.

/** Of the model as given, the best one, and that with a force without a law. */
const runColour = (i, count) => (count === 1 ? "var(--after)" : ["var(--before)", "var(--after)", "var(--noise)"][i]);
const allRegions = (group) => group.region === null;
const regionLabel = (group) => (allRegions(group) ? "whole wall" : words(group.region));

/** "0.38 mm · 2.5 σ" */
function distanceText(group, mm, key = "l2") {
  const noise = group.in_noise ? ` · ${fixed(group.in_noise[key], 1)} σ` : "";
  return `${millimetres(mm * group[key])} mm${noise}`;
}

/** The group of another run, of the same region. */
const sameRegion = (groups, group) => groups.find((g) => g.region === group.region);

function errorRows(sources, runs, kind) {
  return sources[0][kind].all_frames.filter((g) => isNumber(g.l2)).map((first) => {
    const bars = sources.map((source, i) => {
      const group = sameRegion(source[kind].all_frames, first);
      if (!group || !isNumber(group.l2)) return null;
      const mm = runs[i].mm;
      return {
        value: mm * group.l2,
        colour: runColour(i, runs.length),
        text: distanceText(group, mm),
        tip: `${regionLabel(group)}, ${runs[i].label}\nroot mean square ${distanceText(group, mm)}\nmean, signed ${distanceText(group, mm, "mean")}\n95 % of the wall below ${distanceText(group, mm, "p95")}\nlargest ${distanceText(group, mm, "linf")}\n${group.samples} places`,
      };
    }).filter(Boolean);
    const own = first.apparent && isNumber(first.apparent.l2) ? runs[0].mm * first.apparent.l2 : null;
    return { name: regionLabel(first), bars, mark: own === null ? null : { value: own, tip: `The vessel's own motion in these images: ${millimetres(own)} mm. A model that never moved would be off by this much.` } };
  });
}

/** Before and after, per region, of training and held-out frames. */
function errorCharts(runs, index) {
  const sources = runs.map((run) => run.comparison.sources[index]);
  const kinds = [["training", "Training frames"], ["held_out", "Held-out frames: never shown to the model"]];
  const shown = kinds.map(([kind, title]) => ({ title, rows: errorRows(sources, runs, kind) })).filter((k) => k.rows.length);
  if (!shown.some((k) => k.title.startsWith("Held"))) shown[0].title = "All frames (none were held out)";
  const deviation = runs[0].mm * sources[0].noise.deviation;
  const largest = Math.max(...shown.flatMap((k) => k.rows.flatMap((r) => [...r.bars.map((b) => b.value), r.mark ? r.mark.value : 0])), deviation);
  const guide = deviation > 0 ? { value: deviation, text: "noise" } : null;
  const high = largest * 1.05;
  return element("div", { class: "pair", style: shown.length < 2 ? "grid-template-columns:1fr" : null }, shown.map((k) =>
    element("div", {}, element("h3", {}, k.title), barChart({ rows: k.rows, title: "root mean square distance [mm]", guide, high }))));
}

function errorSection(runs) {
  const sources = runs[0].comparison.sources;
  if (!sources.length) return null;
  const keys = legend([
    ...runs.map((run, i) => ({ text: run.label, mark: "bar", colour: runColour(i, runs.length) })),
    { text: "motion of the vessel in the images (yardstick)", mark: "rule", colour: "var(--yardstick)" },
    sources.some((s) => s.noise.deviation > 0) ? { text: "noise of the measurement, 1 σ", mark: "dashed", colour: "var(--noise)" } : null,
  ]);
  return section("errors", "How far the model is from the images", "Distance between the simulated and the imaged inner surface of the vessel, over all frames. A good model comes down to the noise; one whose bar reaches the yardstick explains nothing of the motion.", keys,
    ...tabs(sources.map((source, i) => ({ label: words(source.name), show: () => errorCharts(runs, i) }))));
}

/** Mean signed distance per region and moment, in the noise's deviation, or in mm where no noise is stated. */
function heatTable(source, mm) {
  const regions = [...new Set(source.moments.flatMap((m) => m.groups.map((g) => g.region)))].sort((a, b) => (a === null) - (b === null));
  const inNoise = source.noise.deviation > 0;
  const values = regions.map((region) => source.moments.map((moment) => {
    const group = moment.groups.find((g) => g.region === region);
    if (!group || !isNumber(group.mean)) return null;
    const value = inNoise ? group.in_noise.mean : mm * group.mean;
    const z = isNumber(group.z) ? `\nsignificance z = ${signed(group.z, 1)}` : "";
    return { value, text: signed(value, 1), tip: `${region === null ? "whole wall" : words(region)}, ${number(moment.time)} s${moment.held_out ? ", held out" : ""}\nmean ${signed(mm * group.mean, 2)} mm${inNoise ? ` = ${signed(value, 1)} σ` : ""}: data ${value > 0 ? "outside" : "inside"} the model\nroot mean square ${distanceText(group, mm)}${z}` };
  }));
  return { rows: regions.map((r) => (r === null ? "whole wall" : words(r))), values, inNoise };
}

function heatMaps(runs, index) {
  const tables = runs.map((run) => heatTable(run.comparison.sources[index], run.mm));
  const range = niceAbove(Math.max(...tables.flatMap((t) => t.values.flat().map((v) => (v ? Math.abs(v.value) : 0)))));
  const unit = tables[0].inNoise ? "σ" : "mm";
  const maps = runs.map((run, i) => {
    const moments = run.comparison.sources[index].moments;
    return element("div", {}, element("h3", {}, run.label), heatMap({ ...tables[i], columns: moments.map((m) => number(m.time)), range, axis: i + 1 === runs.length ? "time [s]" : null, marked: moments.map((m) => m.held_out) }));
  });
  return element("div", {}, element("div", { class: "lines" }, maps), element("div", { class: "scale" }, colourBar(range, unit, "data inside the model", "data outside the model")),
    runs[0].comparison.sources[index].moments.some((m) => m.held_out) ? legend([{ text: "held-out frame", mark: "ring", colour: "var(--soft)" }]) : null);
}

function heatSection(runs) {
  const sources = runs[0].comparison.sources.filter((s) => s.moments.length);
  if (!sources.length) return null;
  return section("heat", "Where and when", `Mean signed distance of each region at each frame${sources[0].noise.deviation > 0 ? ", in units of the measurement's noise (σ)" : ", in mm"}. Red: the data lie outside the model, which is too far inward there. Blue: the model is too far outward.`,
    ...tabs(sources.map((source) => ({ label: words(source.name), show: () => heatMaps(runs, runs[0].comparison.sources.indexOf(source)) }))));
}

/** A value in the unit that people use, where there is one: "1.1 mmHg". */
function clinical(run, value, symbol) {
  const known = run.clinical[symbol];
  return known ? `${number(known.factor * value)} ${known.unit}` : withUnit(number(value), unitText(symbol));
}

/** Measured pressures, flows and velocities: what is left, before and after. */
function traceSection(runs) {
  const rows = runs[0].comparison.traces.map((trace, k) => {
    const others = runs.map((run) => run.comparison.traces[k]);
    return element("tr", {}, element("td", {}, element("span", { class: "name" }, words(trace.name)), trace.held_out ? element("div", { class: "minor" }, "held out") : null),
      element("td", {}, trace.observable),
      others.map((t, i) => element("td", { class: "number" }, t && isNumber(t.l2) ? clinical(runs[i], t.l2, t.unit) : "–", t && t.in_noise ? element("div", { class: "minor" }, `${fixed(t.in_noise.l2, 1)} σ`) : null)));
  });
  for (const [k, velocity] of (runs[0].comparison.velocities || []).entries())
    rows.push(element("tr", {}, element("td", {}, element("span", { class: "name" }, words(velocity.name))), element("td", {}, "velocity"),
      runs.map((run) => element("td", { class: "number" }, clinical(run, run.comparison.velocities[k].training.l2, velocity.unit)))));
  if (!rows.length) return null;
  return section("traces", "Pressures, flows, velocities", "Root mean square difference between the run and what was measured, in its unit and in units of its noise.",
    element("div", { class: "scroll" }, element("table", {}, element("thead", {}, element("tr", {}, element("th", {}, "measurement"), element("th", {}, "compared with"), runs.map((run) => element("th", { class: "number" }, run.label)))), element("tbody", {}, rows))));
}
