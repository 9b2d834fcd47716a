import { shape } from "../base/elements.js";
import { isNumber } from "../base/numbers.js";
import { axisBelow, axisLeft, label, line, pathOf, scaleOf } from "./axes.js";
import { responsive } from "./responsive.js";

/**
 * Lines over time with bands. series: [{time, value, lower, upper, colour}]; logarithmic: of the values;
 * marks: [{value, text}] as level lines.
 */
export function bandChart({ series, title, logarithmic = false, marks = [], height = 220 }) {
  return responsive((width) => {
    const left = 74,
      right = width - 12,
      top = 30,
      bottom = height - 44;
    const svg = shape("svg", { width, height, role: "img", "aria-label": title });
    const all = series
      .flatMap((s) => [...(s.lower || s.value), ...(s.upper || s.value)])
      .concat(marks.map((m) => m.value))
      .filter((v) => isNumber(v) && (!logarithmic || v > 0));
    let low = Math.min(...all),
      high = Math.max(...all);
    if (!logarithmic) [low, high] = [low - 0.06 * (high - low), high + 0.06 * (high - low)];
    if (low === high) [low, high] = [low - 1, high + 1];
    const times = series.flatMap((s) => s.time);
    const x = scaleOf(Math.min(...times), Math.max(...times), left, right),
      y = scaleOf(low, high, bottom, top, logarithmic);
    axisLeft(svg, y, left, right, title);
    axisBelow(svg, x, top, bottom, "time [s]");
    const clip = (v) => y(Math.min(high, Math.max(low, v)));
    for (const s of series) {
      const up = s.time.map((t, i) => [x(t), clip(s.upper[i])]),
        down = s.time.map((t, i) => [x(t), clip(s.lower[i])]).reverse();
      svg.append(shape("path", { d: pathOf([...up, ...down]) + "Z", fill: s.colour, opacity: 0.18 }));
      svg.append(
        shape("path", {
          d: pathOf(s.time.map((t, i) => [x(t), clip(s.value[i])])),
          fill: "none",
          stroke: s.colour,
          "stroke-width": 2,
        }),
      );
    }
    for (const mark of marks) {
      svg.append(
        line(left, y(mark.value), right, y(mark.value), { stroke: "var(--faint)", "stroke-dasharray": "4 3" }),
      );
      svg.append(label(right - 4, y(mark.value) + 14, mark.text, { "text-anchor": "end", class: "faint" }));
    }
    return svg;
  });
}
