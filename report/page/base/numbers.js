// Numbers, units and names as people write them.

const superscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

export const minus = (text) => text.replace(/-/g, "−");

export const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

/** "1.02 × 10⁶", "0.38", "12.5": so many significant digits. */
export function number(x, digits = 3) {
  if (!isNumber(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
    return minus(`${Number(mantissa)} × `) + powerOfTen(Number(exponent));
  }
  return minus(String(Number(x.toPrecision(digits))));
}

/** So many places behind the point. */
export const fixed = (x, places) => (isNumber(x) ? minus(x.toFixed(places)).replace(/^−(0(?:\.0*)?)$/, "$1") : "–");

export const signed = (x, places) =>
  isNumber(x) ? (x > 0 && Number(x.toFixed(places)) > 0 ? "+" : "") + fixed(x, places) : "–";

/** A length in mm: two places, three below a tenth. */
export const millimetres = (x) => fixed(x, Math.abs(x) < 0.0995 ? 3 : 2);

export const percent = (x) => (isNumber(x) ? minus(String(Math.round(100 * x))) + " %" : "–");

export const withUnit = (text, unit) => (unit && unit !== "1" ? `${text} ${unit}` : text);

const powerOfTen = (exponent) => `10${[...String(exponent)].map((c) => superscripts[c]).join("")}`;

/** "1.02 (0.91 … 1.13) × 10⁶ g/(cm² s²)": the same power of ten for all three. */
export function interval(a) {
  const exponent = isNumber(a.value) && a.value !== 0 ? Math.floor(Math.log10(Math.abs(a.value))) : 0;
  const common = exponent >= 5 || exponent < -3 ? exponent : 0;
  const [value, lower, upper] = [a.value, a.lower, a.upper].map((x) => (isNumber(x) ? number(x / 10 ** common) : "–"));
  return withUnit(
    `${value} (${a.at_limit ? "its limit" : `${lower} … ${upper}`})${common ? ` × ${powerOfTen(common)}` : ""}`,
    unitText(a.unit),
  );
}

/** A sentence of the results as people write numbers, units and names. */
export const prose = (sentence) =>
  sentence
    .replace(
      /(\d)e([+-]?)0*(\d+)/g,
      (all, digit, sign, power) => `${digit}\u00a0×\u00a0${powerOfTen((sign === "-" ? "-" : "") + power)}`,
    )
    .replace(/\(([a-z]+[a-z0-9 ]*)\)|(?<=[0-9⁰¹²³⁴⁵⁶⁷⁸⁹] )[a-z]+[0-9]?\/(?:[a-z0-9]+|\([a-z0-9 ]+\))/gi, (unit) =>
      unitText(unit),
    )
    .replace(/_/g, " ")
    .replace(/ \.\. /g, " … ")
    .replace(/(^|[ (])-(?=\d)/g, "$1−");

/** Powers in a unit: "g/(cm2 s2)" as people write it. */
export const unitText = (unit) =>
  (unit || "").replace(
    /([a-zA-Z])(-?\d)/g,
    (all, letter, power) => letter + [...power].map((c) => superscripts[c]).join(""),
  );

export const words = (name) => String(name ?? "").replace(/_/g, " ");

/** "below 10⁻⁶", "0.012" */
export const probability = (p) => (!isNumber(p) ? "–" : p < 1e-6 ? "< 10⁻⁶" : p < 1e-3 ? number(p, 1) : number(p, 2));

export function duration(seconds) {
  if (!isNumber(seconds)) return "–";
  if (seconds < 90) return `${number(seconds, 2)} s`;
  if (seconds < 5400) return `${number(seconds / 60, 2)} min`;
  return `${number(seconds / 3600, 2)} h`;
}
