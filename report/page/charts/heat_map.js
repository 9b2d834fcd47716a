import { css, divergingColour, inkOn } from "../base/colours.js";
import { shape } from "../base/elements.js";
import { isNumber } from "../base/numbers.js";
import { label } from "./axes.js";
import { responsive } from "./responsive.js";

/**
 * A heat map on the diverging scale. rows, columns: names; values[row][column]: {value, text, tip} or null;
 * marked[column]: below it a mark.
 */
export function heatMap({ rows, columns, values, range, axis, marked, square = false }) {
  return responsive((width) => {
    const left = Math.min(square ? 250 : 110, width * 0.36);
    const cell = (width - left - 4) / columns.length;
    const tall = square ? Math.min(34, Math.max(16, cell)) : 34;
    const head = square ? 26 : 4,
      bottom = head + rows.length * tall;
    const svg = shape("svg", { width, height: bottom + (axis ? 48 : 6), role: "img", "aria-label": axis || "matrix" });
    rows.forEach((row, i) => {
      const room = Math.floor(left / 6.4);
      svg.append(
        label(left - 8, head + i * tall + tall / 2 + 4, row.length > room ? row.slice(0, room - 1) + "…" : row, {
          "text-anchor": "end",
          tip: row.length > room ? row : null,
        }),
      );
      columns.forEach((column, j) => {
        const one = values[i][j];
        const colour = one && isNumber(one.value) ? divergingColour(one.value / range) : null;
        svg.append(
          shape("rect", {
            x: left + j * cell,
            y: head + i * tall,
            width: cell - 1,
            height: tall - 1,
            rx: 2,
            fill: colour ? css(colour) : "var(--wash)",
            tip: one ? one.tip : null,
            class: "focus",
          }),
        );
        if (colour && one.text && cell > 7 * one.text.length + 2)
          svg.append(
            label(left + (j + 0.5) * cell, head + i * tall + tall / 2 + 4, one.text, {
              "text-anchor": "middle",
              style: `fill:${inkOn(colour)};pointer-events:none;font-size:11.5px`,
            }),
          );
      });
    });
    const stride = Math.max(1, Math.ceil((square ? 20 : 40) / cell));
    columns.forEach((column, j) => {
      const x = left + (j + 0.5) * cell;
      if (square) svg.append(label(x, head - 9, String(j + 1), { "text-anchor": "middle" }));
      if (marked && marked[j])
        svg.append(
          shape("circle", { cx: x, cy: bottom + 6, r: 3, fill: "none", stroke: "var(--soft)", "stroke-width": 1.5 }),
        );
      if (axis && j % stride === 0) svg.append(label(x, bottom + 24, column, { "text-anchor": "middle" }));
    });
    if (axis) svg.append(label(left + (columns.length * cell) / 2, bottom + 42, axis, { "text-anchor": "middle" }));
    return svg;
  });
}
