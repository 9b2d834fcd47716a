import { shape } from "../base/elements.js";
import { axisBelow, label, line, scaleOf } from "./axes.js";
import { responsive } from "./responsive.js";

/**
 * Bars per row, several a row, with a mark for a yardstick.
 * rows: [{name, bars: [{value, colour, tip, text}], mark: {value, tip}}]; guide: {value, text}; unit of the axis.
 */
export function barChart({ rows, title, guide, high }) {
  return responsive((width) => {
    const left = Math.min(120, width * 0.28),
      right = width - 92,
      thick = 13,
      gap = 16;
    const heights = rows.map((row) => row.bars.length * (thick + 3) + gap);
    const top = 20,
      bottom = top + heights.reduce((a, b) => a + b, 0);
    const svg = shape("svg", { width, height: bottom + 42, role: "img", "aria-label": title });
    const x = scaleOf(0, high, left, right);
    axisBelow(svg, x, top - 6, bottom, title);
    if (guide) {
      svg.append(
        line(x(guide.value), top - 6, x(guide.value), bottom, {
          stroke: "var(--noise)",
          "stroke-width": 1.5,
          "stroke-dasharray": "4 3",
        }),
      );
      svg.append(label(x(guide.value), top - 10, guide.text, { "text-anchor": "middle", style: "fill:var(--noise)" }));
    }
    let y = top + gap / 2;
    rows.forEach((row, i) => {
      svg.append(
        label(left - 10, y + (heights[i] - gap) / 2 + 3, row.name, {
          "text-anchor": "end",
          class: i === 0 ? "strong" : "",
        }),
      );
      const begun = y;
      for (const bar of row.bars) {
        svg.append(
          shape("rect", {
            x: left,
            y,
            width: Math.max(1, x(Math.min(bar.value, high)) - left),
            height: thick,
            rx: 2,
            fill: bar.colour,
            tip: bar.tip,
            class: "focus",
          }),
        );
        const beside = x(bar.value) + 8,
          mark = row.mark ? x(row.mark.value) : 0;
        const hidesMark = mark > beside - 5 && mark < beside + 6.4 * bar.text.length + 5;
        svg.append(label(hidesMark ? mark + 8 : beside, y + thick - 2.5, bar.text));
        y += thick + 3;
      }
      if (row.mark)
        svg.append(
          line(x(row.mark.value), begun - 2, x(row.mark.value), y - 1, {
            stroke: "var(--yardstick)",
            "stroke-width": 3,
            tip: row.mark.tip,
          }),
        );
      y += gap;
    });
    return svg;
  });
}
