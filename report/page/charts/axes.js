import { shape } from "../base/elements.js";
import { number } from "../base/numbers.js";

/** The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten. */
export function niceAbove(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((step) => step * power >= x * 0.999);
}

/** A linear or logarithmic way from values to places. */
export function scaleOf(low, high, from, to, logarithmic = false) {
  const f = logarithmic ? Math.log10 : (x) => x;
  const a = f(low),
    b = f(high);
  const scale = (x) => from + ((to - from) * (f(x) - a)) / (b - a || 1);
  return Object.assign(scale, { low, high, logarithmic });
}

/** Round values within a scale, about so many. */
function ticksOf(scale, count = 5) {
  if (scale.logarithmic) {
    const first = Math.ceil(Math.log10(scale.low) - 1e-9),
      last = Math.floor(Math.log10(scale.high) + 1e-9);
    const stride = Math.max(1, Math.ceil((last - first + 1) / count));
    const decades = Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i)).filter(
      (_, i) => i % stride === 0,
    );
    if (decades.length >= 2) return decades;
    const all = [];
    for (let power = first - 1; power <= last; ++power) for (const m of [1, 2, 3, 5]) all.push(m * 10 ** power);
    return all.filter((x) => x >= scale.low * 0.999 && x <= scale.high * 1.001);
  }
  const raw = (scale.high - scale.low) / count,
    power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= raw * 0.999);
  const ticks = [];
  for (let x = Math.ceil(scale.low / step - 1e-9) * step; x <= scale.high + 1e-9 * step; x += step)
    ticks.push(Math.abs(x) < step * 1e-9 ? 0 : x);
  return ticks;
}

export const line = (x1, y1, x2, y2, attributes = {}) => shape("line", { x1, y1, x2, y2, ...attributes });

export const label = (x, y, text, attributes = {}) => shape("text", { x, y, ...attributes }, text);

export const pathOf = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** An axis below: ticks, numbers, and what it is. */
export function axisBelow(svg, x, top, bottom, title, text = (v) => number(v)) {
  const [left, right] = [x(x.low), x(x.high)];
  for (const tick of ticksOf(x, Math.max(2, Math.floor((right - left) / 75)))) {
    svg.append(line(x(tick), top, x(tick), bottom, { class: "grid" }));
    svg.append(label(x(tick), bottom + 16, text(tick), { "text-anchor": "middle" }));
  }
  svg.append(line(left, bottom, right, bottom, { class: "axis" }));
  if (title) svg.append(label((left + right) / 2, bottom + 34, title, { "text-anchor": "middle" }));
}

export function axisLeft(svg, y, left, right, title, text = (v) => number(v)) {
  const [bottom, top] = [y(y.low), y(y.high)];
  for (const tick of ticksOf(y, Math.max(2, Math.floor((bottom - top) / 42)))) {
    svg.append(line(left, y(tick), right, y(tick), { class: "grid" }));
    svg.append(label(left - 8, y(tick) + 4, text(tick), { "text-anchor": "end" }));
  }
  if (title) svg.append(label(0, top - 12, title));
}
