import { shape } from "../base/elements.js";
import { isNumber } from "../base/numbers.js";
import { line, scaleOf } from "./axes.js";

/** An amplitude with its interval, from the value without the effect: a small drawing. */
export function amplitudeDrawing(a) {
  const ends = [a.without, a.lower, a.upper, a.value].filter(isNumber);
  if (!isNumber(a.value) || ends.length < 2) return null;
  const width = 130,
    low = Math.min(...ends),
    high = Math.max(...ends);
  const x = scaleOf(low, high === low ? low + 1 : high, 6, width - 6);
  const svg = shape("svg", { width, height: 16, "aria-hidden": "true" }, line(6, 8, width - 6, 8, { class: "grid" }));
  if (isNumber(a.lower) && isNumber(a.upper) && !a.at_limit)
    svg.append(
      line(x(a.lower), 8, x(a.upper), 8, {
        stroke: "var(--accent)",
        "stroke-width": 5,
        "stroke-linecap": "round",
        opacity: 0.35,
      }),
    );
  if (isNumber(a.without))
    svg.append(line(x(a.without), 2, x(a.without), 14, { stroke: "var(--faint)", "stroke-width": 1.5 }));
  svg.append(shape("circle", { cx: x(a.value), cy: 8, r: 4, fill: "var(--accent)" }));
  return svg;
}

/** A bar from 0 to 1, or both ways around 0, with its text. */
export function smallBar(value, high, text, colour = "var(--accent)", range = null) {
  const width = 70,
    negative = isNumber(value) && value < 0;
  const length = isNumber(value) ? Math.min(1, Math.abs(value) / high) * width : 0;
  const svg = shape(
    "svg",
    { width, height: 8, "aria-hidden": "true" },
    shape("rect", { width, height: 6, y: 1, rx: 3, fill: "var(--wash)" }),
    shape("rect", { width: length, height: 6, y: 1, rx: 3, fill: negative ? "var(--faint)" : colour }),
  );
  if (range && isNumber(range.lower) && isNumber(range.upper)) {
    const at = (v) => Math.max(0, Math.min(1, v / high)) * width;
    svg.append(line(at(range.lower), 4, at(range.upper), 4, { stroke: "var(--ink)", "stroke-width": 1.5 }));
  }
  return [text, svg];
}
