import { css, divergingColour } from "../base/colours.js";
import { shape } from "../base/elements.js";
import { number, withUnit } from "../base/numbers.js";
import { responsive } from "./responsive.js";

/** The scale as a bar with ticks from -range to range. */
export function colourBar(range, unit, below, above) {
  return responsive((width) => {
    const left = 14,
      bar = width - 2 * left;
    const svg = shape("svg", {
      width,
      height: 62,
      role: "img",
      "aria-label": `Colour scale from ${-range} to ${range} ${unit}`,
    });
    const count = 80;
    for (let i = 0; i < count; ++i)
      svg.append(
        shape("rect", {
          x: left + (bar * i) / count,
          y: 20,
          width: bar / count + 0.6,
          height: 13,
          fill: css(divergingColour((2 * (i + 0.5)) / count - 1)),
        }),
      );
    for (const share of [-1, -0.5, 0, 0.5, 1]) {
      const x = left + (bar * (share + 1)) / 2;
      svg.append(shape("line", { x1: x, x2: x, y1: 33, y2: 38, class: "axis" }));
      svg.append(
        shape(
          "text",
          { x, y: 51, "text-anchor": "middle" },
          withUnit((share > 0 ? "+" : "") + number(share * range), share === 1 ? unit : ""),
        ),
      );
    }
    svg.append(
      shape("text", { x: left, y: 12 }, `◂ ${below}`),
      shape("text", { x: left + bar, y: 12, "text-anchor": "end" }, `${above} ▸`),
    );
    return svg;
  });
}
