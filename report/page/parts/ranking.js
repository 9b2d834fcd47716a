import { element, section, tabs } from "../base/elements.js";
import { effectName } from "../base/names.js";
import { interval, isNumber, number, percent, probability, signed, words } from "../base/numbers.js";
import { amplitudeDrawing, smallBar } from "../charts/drawings.js";

// What the diagnosis found: ranking, look-alikes, what these data would show, what was tried.

const kindText = { input: "a number of the model", data: "an error of the data" };

function effectStatus(effect) {
  const chips = effect.accepted ? [element("span", { class: "chip good" }, "accepted"), " "] : [];
  if (effect.group !== null && effect.group !== undefined)
    chips.push(
      element(
        "span",
        {
          class: "chip",
          tip: `These effects change the model in nearly the same way (group ${effect.group}, cosine ${number(effect.cosine, 2)} with its first): these data can hardly tell one from another.`,
        },
        `look-alike ${effect.group}`,
      ),
    );
  return chips;
}

function rankingRow(effect, rank, strongest) {
  const gain = effect.held_out_gain;
  const a = effect.amplitude || {};
  return element(
    "tr",
    {
      class: [effect.accepted ? "accepted" : "", rank > 12 ? "past" : ""].join(" ").trim() || null,
      "data-effect": effect.name,
    },
    element("td", { class: "rank" }, String(rank)),
    element(
      "td",
      {},
      element("div", { class: "name" }, effectName(effect)),
      element("div", { class: "minor" }, [effect.meaning, kindText[effect.kind]].filter(Boolean).join(" · ")),
      effectStatus(effect),
    ),
    element(
      "td",
      { class: "amount" },
      isNumber(a.value) ? interval(a) : "–",
      element(
        "div",
        { class: "minor" },
        `${a.parameter ? words(String(a.parameter).split(".").pop()) : ""}${isNumber(a.without) ? `, in the model ${number(a.without)}` : ""}${effect.confirmed_by_runs ? "" : " · first order"}`,
      ),
      amplitudeDrawing(a),
    ),
    element("td", { class: "number" }, smallBar(effect.z, strongest, signed(effect.z, 1))),
    element("td", { class: "number" }, probability(effect.q)),
    element(
      "td",
      { class: "number" },
      gain ? smallBar(gain.value, 1, percent(gain.value), "var(--good)", gain) : "–",
      gain ? element("div", { class: "minor" }, `${percent(gain.lower)} … ${percent(gain.upper)}`) : null,
    ),
    element(
      "td",
      { class: "number" },
      isNumber(effect.retained_information)
        ? smallBar(effect.retained_information, 1, percent(effect.retained_information))
        : "–",
    ),
  );
}

/** All candidates, the first twelve seen at once. */
function rankingTable(effects) {
  const strongest = Math.max(1, ...effects.map((e) => Math.abs(e.z || 0)));
  const head = [
    ["#", ""],
    [
      "candidate",
      "An effect that the model could be given, a number of it that may be wrong, or an error of the data that would look like one.",
    ],
    [
      "amount, 95 % interval",
      "The value that fits the data best. The drawing runs from the model's value (line) to the estimate (dot) and its interval (band). 'First order': estimated from the model's sensitivity only, not yet confirmed by runs.",
    ],
    [
      "z",
      "Evidence in standard deviations of noise, after all allowed errors have been taken out. Negative: the data would want the opposite.",
    ],
    ["q", "Probability of so much evidence by chance, corrected for the number of candidates. Below 0.05 it counts."],
    [
      "held-out gain",
      "Share of the distance on held-out frames that the effect removes; the thin line is its 95 % interval.",
    ],
    [
      "information kept",
      "Of what the data say about this effect, the share that uncertain inputs and other allowed errors could not explain as well. Near zero: the data cannot tell.",
    ],
  ];
  const table = element(
    "table",
    {},
    element(
      "thead",
      {},
      element(
        "tr",
        {},
        head.map(([text, tip], i) => element("th", { class: i > 2 ? "number" : null, tip: tip || null }, text)),
      ),
    ),
    element(
      "tbody",
      {},
      effects.map((effect, i) => rankingRow(effect, i + 1, strongest)),
    ),
  );
  const more =
    effects.length > 12
      ? element("button", { type: "button", class: "more-button" }, `Show all ${effects.length}`)
      : null;
  if (more)
    more.addEventListener("click", () => {
      const whole = table.classList.toggle("whole");
      more.textContent = whole ? "Show the first 12" : `Show all ${effects.length}`;
    });
  return element("div", {}, element("div", { class: "scroll" }, table), more);
}

/** The rankings of each model's diagnosis; of an explanation without diagnoses its own. */
function rankingsOf(report) {
  const all = report.diagnoses.map((d) => ({
    label: d.label ? `what ${d.label} lacks` : "candidates",
    effects: d.diagnosis.effects || [],
    diagnosis: d.diagnosis,
  }));
  if (!all.length && report.explain && (report.explain.effects || []).length)
    all.push({ label: "candidates", effects: report.explain.effects, diagnosis: report.explain });
  return all.filter((r) => r.effects.length);
}

export function rankingSection(report) {
  const rankings = rankingsOf(report);
  if (!rankings.length) return null;
  return section(
    "ranking",
    "What could explain the difference",
    "Every effect that the model could be given was switched on in a run of its own, beside inputs that may be wrong and errors that the data may have. The ranking says what the measurements want.",
    ...tabs(
      rankings.map((r) => ({
        label: r.label,
        show: () => element("div", {}, rankingTable(r.effects), pathTable(r.diagnosis)),
      })),
    ),
  );
}

/** What was tried, and why it was not accepted. */
function pathTable(diagnosis) {
  const path = diagnosis.path || [];
  if (!path.length) return null;
  return element(
    "p",
    { class: "note" },
    path
      .map(
        (step, i) =>
          `${i ? " Then" : "Tried:"} ${effectName(step)} — ${step.accepted ? "accepted" : `rejected, ${step.reason}`}${isNumber(step.misfit_before) ? ` (misfit ${number(step.misfit_before)} → ${number(step.misfit_after)})` : ""}.`,
      )
      .join(""),
  );
}
