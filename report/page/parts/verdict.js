// What was found, from the fields of the results; the sentences are shown, never read.
import { element } from "../base/elements.js";
import { effectName } from "../base/names.js";
import { interval, isNumber, prose } from "../base/numbers.js";

/** By `verdict`: the chip, its colour, and the word with which the first sentence begins. */
const verdicts = {
  missing: { chip: "Missing effect found", colour: "bad", word: "MISSING: " },
  nothing_missing: { chip: "Nothing missing", colour: "good", word: "NOTHING MISSING: " },
  ambiguous: { chip: "Cannot tell which", colour: "open", word: "AMBIGUOUS: " },
  not_in_catalogue: { chip: "Not in the catalogue", colour: "open", word: "NOT IN THE CATALOGUE: " },
  undecided: { chip: "Undecided", colour: "open", word: "UNDECIDED: " },
};

/** What was accepted: of an explanation, what was added on the way to its best model, and errors that were named. */
function found(report) {
  if (!report.explain) return (report.diagnoses[0]?.diagnosis.effects || []).filter((effect) => effect.accepted);
  const { models, best, effects } = report.explain;
  const added = models.filter((m) => m.accepted && m.number <= best).flatMap((m) => m.added);
  const errors = (effects || []).filter((e) => e.accepted && (e.kind === "data" || e.kind === "numerics"));
  return [...added, ...errors];
}

/** An error of the data is no effect that the model lacks. Nothing if there is no verdict. */
export function chipOf(report) {
  const all = report.verdict === "missing" ? found(report) : [];
  const allAre = (kind) => all.length > 0 && all.every((effect) => effect.kind === kind);
  if (allAre("data")) return { chip: "The data are off", colour: "open" };
  if (allAre("numerics")) return { chip: "The numerics are too coarse", colour: "open" };
  return verdicts[report.verdict];
}

const capital = (text) => text.slice(0, 1).toUpperCase() + text.slice(1);
const amountOf = (effect) => {
  const amount = effect.amplitude && isNumber(effect.amplitude.value) ? `, ${interval(effect.amplitude)}` : "";
  return effectName(effect) + amount;
};

/** An accepted effect and those of its diagnosis that the data cannot tell from it; alone if there are none. */
function alikeWith(effect, effects) {
  const rivals = effects.filter((other) => other.rival && effect.group !== null && other.group === effect.group);
  return [effect, ...rivals];
}

/** Of one diagnosis that left one choice among more than two: what cannot be told apart, and what stands beside it. */
function choice(report) {
  const ambiguous = report.diagnoses.map((d) => d.diagnosis).filter((d) => d.verdict === "ambiguous");
  if (report.verdict !== "ambiguous" || ambiguous.length !== 1) return null;
  const { effects } = ambiguous[0];
  const groups = effects.filter((e) => e.accepted).map((e) => alikeWith(e, effects));
  const unclear = groups.filter((group) => group.length > 1);
  if (unclear.length !== 1 || unclear[0].length < 3) return null;
  const names = unclear[0].map(effectName);
  const beside = (report.explain ? found(report) : groups.map(([first]) => first)).filter(
    (effect) => !names.includes(effectName(effect)),
  );
  return { alike: unclear[0], beside };
}

function choiceHeadline({ alike, beside }) {
  const of = ({ kind }) =>
    ({ data: "The data are off: ", numerics: "The numerics are too coarse: " })[kind] || "Beside it: ";
  return [
    element("p", { class: "verdict" }, `These data cannot tell ${alike.length} effects from each other`),
    list([...alike.map(amountOf), ...beside.map((effect) => of(effect) + amountOf(effect))]),
  ];
}

/** The first sentence large, without its first word, which the chip says; what cannot be told apart as a list. */
export function headline(report, first) {
  const alternatives = choice(report);
  if (alternatives) return choiceHeadline(alternatives);
  const { word = "" } = verdicts[report.verdict] || {};
  const sentence = capital(prose(first.startsWith(word) ? first.slice(word.length) : first));
  return [element("p", { class: sentence.length > 110 ? "verdict long" : "verdict" }, sentence)];
}

const list = (texts) =>
  element(
    "ul",
    { class: "further" },
    texts.map((text) => element("li", {}, capital(text))),
  );

export const furtherSentences = (sentences) => (sentences.length ? list(sentences.map(prose)) : null);
