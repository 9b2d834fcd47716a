import { element, section, shape } from "../base/elements.js";
import { effectName } from "../base/names.js";
import { fixed, interval, isNumber, millimetres, number, percent, words } from "../base/numbers.js";
import { axisLeft, label, line, pathOf, scaleOf } from "../charts/axes.js";
import { responsive } from "../charts/responsive.js";
import { legend } from "../charts/legend.js";

// The path from the model as given to the best one; what was identified on the way; what force is still missing.

const modelName = (model) => `${model.number} · ${words(model.name)}`;

/** Distances on training and held-out frames, model by model. */
function pathChart(models, mm, noise) {
  return responsive((width) => {
    const left = 60,
      right = width - 20,
      top = 26,
      bottom = 210;
    const svg = shape("svg", { width, height: 256, role: "img", "aria-label": "distance of each model" });
    const kinds = [
      ["training", "var(--faint)"],
      ["held_out", "var(--accent)"],
    ];
    const values = models.flatMap((m) => kinds.map(([k]) => (m[k] ? mm * m[k].l2 : NaN))).filter(isNumber);
    const y = scaleOf(0, Math.max(...values, noise || 0) * 1.12, bottom, top);
    const x = (i) =>
      models.length === 1 ? (left + right) / 2 : left + 40 + ((right - left - 80) * i) / (models.length - 1);
    axisLeft(svg, y, left, right, "root mean square distance [mm]");
    if (noise) {
      svg.append(
        shape("rect", {
          x: left,
          y: y(noise),
          width: right - left,
          height: bottom - y(noise),
          fill: "var(--noise)",
          opacity: 0.1,
        }),
      );
      svg.append(label(left + 8, bottom - 8, "noise of the measurement, 1 σ", { style: "fill:var(--noise)" }));
    }
    svg.append(line(left, bottom, right, bottom, { class: "axis" }));
    for (const [kind, colour] of kinds) {
      const kept = models.map((m, i) => [m, i]).filter(([m]) => m[kind]);
      svg.append(
        shape("path", {
          d: pathOf(kept.filter(([m]) => m.accepted).map(([m, i]) => [x(i), y(mm * m[kind].l2)])),
          fill: "none",
          stroke: colour,
          "stroke-width": 2,
        }),
      );
      for (const [m, i] of kept) {
        const tip = `${modelName(m)}\n${kind === "held_out" ? "held-out" : "training"} frames: ${millimetres(mm * m[kind].l2)} mm${isNumber(m[kind].in_noise) ? ` · ${fixed(m[kind].in_noise, 1)} σ` : ""}${m.accepted ? "" : `\nrejected: ${m.reason}`}`;
        svg.append(
          shape("circle", {
            cx: x(i),
            cy: y(mm * m[kind].l2),
            r: 5.5,
            fill: m.accepted ? colour : "var(--card)",
            stroke: colour,
            "stroke-width": 2,
            tip,
          }),
        );
        if (kind === "held_out" || !m.held_out)
          svg.append(label(x(i) + 10, y(mm * m[kind].l2) - 8, millimetres(mm * m[kind].l2), { class: "strong" }));
      }
    }
    models.forEach((m, i) =>
      svg.append(
        label(x(i), bottom + 18, `model ${m.number}`, { "text-anchor": "middle", class: "strong" }),
        label(x(i), bottom + 34, m.accepted ? "" : "rejected", { "text-anchor": "middle" }),
      ),
    );
    return svg;
  });
}

/** An effect that was added: what, where, how much of each of its numbers. */
function addedText(added) {
  const amounts = added.parameters && added.parameters.length ? added.parameters : [added.amplitude || added];
  const one = (a) =>
    element(
      "div",
      {},
      interval(a),
      element(
        "div",
        { class: "minor" },
        `${a.parameter ? words(String(a.parameter).split(".").pop()) : ""}${isNumber(a.without) ? `, before ${number(a.without)}` : ""}`,
      ),
    );
  return element(
    "div",
    {},
    element("span", { class: "name" }, effectName(added.amplitude ? added : { ...added, parameter: null })),
    amounts.map(one),
  );
}

function modelRow(model, mm) {
  const distance = (d) =>
    d
      ? [
          `${millimetres(mm * d.l2)} mm`,
          isNumber(d.in_noise) ? element("div", { class: "minor" }, `${fixed(d.in_noise, 1)} σ`) : null,
        ]
      : "–";
  const gain = model.held_out_gain;
  return element(
    "tr",
    {},
    element(
      "td",
      {},
      element("span", { class: "name" }, modelName(model)),
      element("div", { class: "minor" }, model.case || ""),
    ),
    element("td", { class: "amount" }, (model.added || []).length ? model.added.map(addedText) : "–"),
    element("td", { class: "number" }, distance(model.training)),
    element("td", { class: "number" }, distance(model.held_out)),
    element(
      "td",
      { class: "number" },
      gain
        ? [percent(gain.value), element("div", { class: "minor" }, `${percent(gain.lower)} … ${percent(gain.upper)}`)]
        : "–",
    ),
    element(
      "td",
      {},
      model.accepted
        ? element("span", { class: "chip good" }, model.number === 0 ? "start" : "accepted")
        : [element("span", { class: "chip bad" }, "rejected"), element("div", { class: "minor" }, model.reason || "")],
    ),
  );
}

export function modelsSection(report) {
  const models = report.explain ? report.explain.models || [] : [];
  if (!models.length) return null;
  const run = report.runs[0],
    mm = run ? run.mm : 1;
  const source = run && run.comparison.sources[0];
  const noise = source && source.noise.deviation > 0 ? mm * source.noise.deviation : null;
  return section(
    "models",
    "The models, one after the other",
    "One effect at a time was added, its size identified from the training frames, and the new model run again without any help from the data. A step that the held-out frames do not confirm is reverted.",
    pathChart(models, mm, noise),
    legend([
      { text: "held-out frames", mark: "dot", colour: "var(--accent)" },
      { text: "training frames", mark: "dot", colour: "var(--faint)" },
      models.some((m) => !m.accepted) ? { text: "rejected", mark: "ring", colour: "var(--faint)" } : null,
    ]),
    element(
      "div",
      { class: "scroll" },
      element(
        "table",
        {},
        element(
          "thead",
          {},
          element(
            "tr",
            {},
            ["model", "added", "training", "held out", "held-out gain", ""].map((t, i) =>
              element("th", { class: i > 1 && i < 5 ? "number" : null }, t),
            ),
          ),
        ),
        element(
          "tbody",
          {},
          models.map((m) => modelRow(m, mm)),
        ),
      ),
    ),
  );
}
