"use strict";
// One diverging scale for all signed distances: blue where the data lie inside the model, red where they lie outside,
// near white at zero. It is that of ColorBrewer's RdBu, which people with any colour vision can read.

const divergingStops = ["#1f5fa8", "#4a90c6", "#9cc7e0", "#f3f1ec", "#f4b393", "#d9694f", "#a81529"].map((hex) =>
  [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)),
);

/** x from -1 to 1, beyond it the ends: [red, green, blue] of 255. */
function divergingColour(x) {
  const at = ((Math.max(-1, Math.min(1, x)) + 1) / 2) * (divergingStops.length - 1);
  const k = Math.min(divergingStops.length - 2, Math.floor(at));
  return divergingStops[k].map((c, i) => Math.round(c + (at - k) * (divergingStops[k + 1][i] - c)));
}

const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
/** Of text on that colour. */
const inkOn = ([r, g, b]) => (0.299 * r + 0.587 * g + 0.114 * b > 140 ? "#1a2027" : "#ffffff");
/** What the style sheet calls --name. */
const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
/** "#rrggbb" as [r, g, b] of 1. */
const unitColour = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/** The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten. */
function niceAbove(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((step) => step * power >= x * 0.999);
}

/** The scale as a bar with ticks from -range to range. */
function colourBar(range, unit, below, above) {
  return responsive((width) => {
    const left = 14, bar = width - 2 * left;
    const svg = shape("svg", { width, height: 62, role: "img", "aria-label": `Colour scale from ${-range} to ${range} ${unit}` });
    const count = 80;
    for (let i = 0; i < count; ++i)
      svg.append(shape("rect", { x: left + (bar * i) / count, y: 20, width: bar / count + 0.6, height: 13, fill: css(divergingColour((2 * (i + 0.5)) / count - 1)) }));
    for (const share of [-1, -0.5, 0, 0.5, 1]) {
      const x = left + (bar * (share + 1)) / 2;
      svg.append(shape("line", { x1: x, x2: x, y1: 33, y2: 38, class: "axis" }));
      svg.append(shape("text", { x, y: 51, "text-anchor": "middle" }, withUnit((share > 0 ? "+" : "") + number(share * range), share === 1 ? unit : "")));
    }
    svg.append(shape("text", { x: left, y: 12 }, `◂ ${below}`), shape("text", { x: left + bar, y: 12, "text-anchor": "end" }, `${above} ▸`));
    return svg;
  });
}
