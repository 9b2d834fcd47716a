"use strict";
// What the diagnosis found: ranking, look-alikes, what these data would show, what was tried.

const kindText = { input: "a number of the model", data: "an error of the data" };

/** An amplitude with its interval, from the value without the effect: a small drawing. */
function amplitudeDrawing(a) {
  const ends = [a.without, a.lower, a.upper, a.value].filter(isNumber);
  if (!isNumber(a.value) || ends.length < 2) return null;
  const width = 130, low = Math.min(...ends), high = Math.max(...ends);
  const x = scaleOf(low, high === low ? low + 1 : high, 6, width - 6);
  const svg = shape("svg", { width, height: 16, "aria-hidden": "true" }, line(6, 8, width - 6, 8, { class: "grid" }));
  if (isNumber(a.lower) && isNumber(a.upper) && !a.at_limit) svg.append(line(x(a.lower), 8, x(a.upper), 8, { stroke: "var(--accent)", "stroke-width": 5, "stroke-linecap": "round", opacity: 0.35 }));
  if (isNumber(a.without)) svg.append(line(x(a.without), 2, x(a.without), 14, { stroke: "var(--faint)", "stroke-width": 1.5 }));
  svg.append(shape("circle", { cx: x(a.value), cy: 8, r: 4, fill: "var(--accent)" }));
  return svg;
}

/** A bar from 0 to 1, or both ways around 0, with its text. */
function smallBar(value, high, text, colour = "var(--accent)", range = null) {
  const width = 70, negative = isNumber(value) && value < 0;
  const length = isNumber(value) ? Math.min(1, Math.abs(value) / high) * width : 0;
  const svg = shape("svg", { width, height: 8, "aria-hidden": "true" }, shape("rect", { width, height: 6, y: 1, rx: 3, fill: "var(--wash)" }), shape("rect", { width: length, height: 6, y: 1, rx: 3, fill: negative ? "var(--faint)" : colour }));
  if (range && isNumber(range.lower) && isNumber(range.upper)) {
    const at = (v) => Math.max(0, Math.min(1, v / high)) * width;
    svg.append(line(at(range.lower), 4, at(range.upper), 4, { stroke: "var(--ink)", "stroke-width": 1.5 }));
  }
  return [text, svg];
}

function effectStatus(effect) {
  const chips = effect.accepted ? [element("span", { class: "chip good" }, "accepted"), " "] : [];
  if (effect.group !== null && effect.group !== undefined) chips.push(element("span", { class: "chip", tip: `These effects change the model in nearly the same way (group ${effect.group}, cosine ${number(effect.cosine, 2)} with its first): these data can hardly tell one from another.` }, `look-alike ${effect.group}`));
  return chips;
}

function rankingRow(effect, rank, strongest) {
  const gain = effect.held_out_gain;
  const a = effect.amplitude || {};
  return element("tr", { class: [effect.accepted ? "accepted" : "", rank > 12 ? "past" : ""].join(" ").trim() || null, "data-effect": effect.name },
    element("td", { class: "rank" }, String(rank)),
    element("td", {}, element("div", { class: "name" }, effectName(effect)), element("div", { class: "minor" }, [effect.meaning, kindText[effect.kind]].filter(Boolean).join(" · ")), effectStatus(effect)),
    element("td", { class: "amount" }, isNumber(a.value) ? interval(a) : "–", element("div", { class: "minor" }, `${a.parameter ? words(String(a.parameter).split(".").pop()) : ""}${isNumber(a.without) ? `, in the model ${number(a.without)}` : ""}${effect.confirmed_by_runs ? "" : " · first order"}`), amplitudeDrawing(a)),
    element("td", { class: "number" }, smallBar(effect.z, strongest, signed(effect.z, 1))),
    element("td", { class: "number" }, probability(effect.q)),
    element("td", { class: "number" }, gain ? smallBar(gain.value, 1, percent(gain.value), "var(--good)", gain) : "–", gain ? element("div", { class: "minor" }, `${percent(gain.lower)} … ${percent(gain.upper)}`) : null),
    element("td", { class: "number" }, isNumber(effect.retained_information) ? smallBar(effect.retained_information, 1, percent(effect.retained_information)) : "–"));
}

/** All candidates, the first twelve seen at once. */
function rankingTable(effects) {
  const strongest = Math.max(1, ...effects.map((e) => Math.abs(e.z || 0)));
  const head = [
    ["#", ""],
    ["candidate", "An effect that the model could be given, a number of it that may be wrong, or an error of the data that would look like one."],
    ["amount, 95 % interval", "The value that fits the data best. The drawing runs from the model's value (line) to the estimate (dot) and its interval (band). 'First order': estimated from the model's sensitivity only, not yet confirmed by runs."],
    ["z", "Evidence in standard deviations of noise, after all allowed errors have been taken out. Negative: the data would want the opposite."],
    ["q", "Probability of so much evidence by chance, corrected for the number of candidates. Below 0.05 it counts."],
    ["held-out gain", "Share of the distance on held-out frames that the effect removes; the thin line is its 95 % interval."],
    ["information kept", "Of what the data say about this effect, the share that uncertain inputs and other allowed errors could not explain as well. Near zero: the data cannot tell."],
  ];
  const table = element("table", {}, element("thead", {}, element("tr", {}, head.map(([text, tip], i) => element("th", { class: i > 2 ? "number" : null, tip: tip || null }, text)))), element("tbody", {}, effects.map((effect, i) => rankingRow(effect, i + 1, strongest))));
  const more = effects.length > 12 ? element("button", { type: "button", class: "more-button" }, `Show all ${effects.length}`) : null;
  if (more) more.addEventListener("click", () => {
    const whole = table.classList.toggle("whole");
    more.textContent = whole ? "Show the first 12" : `Show all ${effects.length}`;
  });
  return element("div", {}, element("div", { class: "scroll" }, table), more);
}

/** The rankings of each model's diagnosis; of an explanation without diagnoses its own. */
function rankingsOf(report) {
  const all = report.diagnoses.map((d) => ({ label: d.label ? `what ${d.label} lacks` : "candidates", effects: d.diagnosis.effects || [], diagnosis: d.diagnosis }));
  if (!all.length && report.explain && (report.explain.effects || []).length) all.push({ label: "candidates", effects: report.explain.effects, diagnosis: report.explain });
  return all.filter((r) => r.effects.length);
}

function rankingSection(report) {
  const rankings = rankingsOf(report);
  if (!rankings.length) return null;
  return section("ranking", "What could explain the difference", "Every effect that the model could be given was switched on in a run of its own, beside inputs that may be wrong and errors that the data may have. The ranking says what the measurements want.",
    ...tabs(rankings.map((r) => ({ label: r.label, show: () => element("div", {}, rankingTable(r.effects), pathTable(r.diagnosis)) }))));
}

/** What was tried, and why it was not accepted. */
function pathTable(diagnosis) {
  const path = diagnosis.path || [];
  if (!path.length) return null;
  return element("p", { class: "note" }, path.map((step, i) => `${i ? " Then" : "Tried:"} ${effectName(step)} — ${step.accepted ? "accepted" : `rejected, ${step.reason}`}${isNumber(step.misfit_before) ? ` (misfit ${number(step.misfit_before)} → ${number(step.misfit_after)})` : ""}.`).join(""));
}

function lookAlikeSection(report) {
  const matrices = report.diagnoses.filter((d) => Array.isArray(d.diagnosis.look_alike) && d.diagnosis.look_alike.length > 1);
  if (!matrices.length) return null;
  const drawn = (diagnosis) => {
    const cosines = diagnosis.look_alike, effects = diagnosis.effects.slice(0, cosines.length);
    const values = cosines.map((row, i) => row.map((c, j) => (isNumber(c) ? { value: c, text: fixed(c, 2).replace("0.", "."), tip: i === j ? effectName(effects[i]) : `${effectName(effects[i])}\n${effectName(effects[j])}\ncosine ${fixed(c, 2)}` } : null)));
    return element("div", {}, heatMap({ rows: effects.map((e, i) => `${i + 1}  ${effectName(e)}`), columns: effects.map((_, i) => String(i + 1)), values, range: 1, square: true }),
      element("div", { class: "scale" }, colourBar(1, "", "opposite", "the same")));
  };
  return section("look-alikes", "What looks alike", "How similar the strongest candidates' effects on the measurements are. A cosine of 1: both change the model in the same way, and no analysis of these data can tell them apart; a further measurement could. Above 0.9 they are reported as a group. Near 0: independent.",
    ...tabs(matrices.map((d) => ({ label: d.label || "candidates", show: () => drawn(d.diagnosis) }))));
}

/** The smallest amount that these data show, over the size that it may have in a patient. */
function detectableChart(list) {
  return responsive((width) => {
    const left = Math.min(270, width * 0.46), right = width - 20, tall = 24, top = 24, bottom = top + list.length * tall;
    const svg = shape("svg", { width, height: bottom + 44, role: "img", "aria-label": "detectability" });
    const sizes = list.map((d) => d.in_scale);
    const x = scaleOf(Math.min(0.1, ...sizes) / 1.3, Math.max(10, ...sizes) * 1.3, left, right, true);
    svg.append(shape("rect", { x: left, y: top - 6, width: x(1) - left, height: bottom - top + 6, fill: "var(--good)", opacity: 0.09 }));
    axisBelow(svg, x, top - 6, bottom, width < 520 ? "smallest visible ÷ plausible size" : "smallest amount seen with 80 % probability ÷ size that it may have in a patient");
    svg.append(line(x(1), top - 6, x(1), bottom, { stroke: "var(--good)", "stroke-width": 1.5 }));
    svg.append(label(x(1) - 6, top - 11, "would be seen", { "text-anchor": "end", style: "fill:var(--good)" }), label(x(1) + 6, top - 11, "may go unseen", {}));
    list.forEach((d, i) => {
      const y = top + (i + 0.5) * tall, name = placedName(d), room = Math.floor(left / 6.3);
      svg.append(label(left - 10, y + 4, name.length > room ? name.slice(0, room - 1) + "…" : name, { "text-anchor": "end" }));
      svg.append(line(left, y, x(d.in_scale), y, { stroke: "var(--line)", "stroke-width": 2 }));
      svg.append(shape("circle", { cx: x(d.in_scale), cy: y, r: 5, fill: d.in_scale <= 1 ? "var(--good)" : "var(--faint)", tip: `${name}\nseen from ${withUnit(number(d.value), unitText(d.unit))} on (in the model ${number(d.without)})\n${number(d.in_scale, 2)} of the size that it may have in a patient` }));
    });
    return svg;
  });
}

function detectableSection(report) {
  const diagnoses = report.diagnoses.map((d) => d.diagnosis);
  const list = report.explain && (report.explain.detectable || []).length ? report.explain.detectable : (diagnoses.at(-1) || {}).detectable || [];
  const drawn = list.filter((d) => isNumber(d.in_scale) && d.in_scale > 0).sort((a, b) => a.in_scale - b.in_scale);
  if (!drawn.length) return null;
  const first = drawn.slice(0, 16), rest = drawn.slice(16);
  const blind = list.length - drawn.length;
  return section("detectable", "What these data would have shown", "A verdict is worth as much as the data can see. For each effect: the smallest amount that these measurements reveal in four of five cases, compared with the size that it may have in a patient. Left of the line it would have been found if it were there.",
    detectableChart(first),
    rest.length ? element("details", {}, element("summary", {}, `${rest.length} more`), detectableChart(rest)) : null,
    blind > 0 ? element("p", { class: "note" }, `${blind} further candidate${blind > 1 ? "s" : ""} cannot be seen in these data at any size, or no plausible size is known.`) : null);
}
