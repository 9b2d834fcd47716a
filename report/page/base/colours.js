// One diverging scale for all signed distances: blue where the data lie inside the model, red where they lie outside,
// near white at zero. It is that of ColorBrewer's RdBu, which people with any colour vision can read.

const divergingStops = ["#1f5fa8", "#4a90c6", "#9cc7e0", "#f3f1ec", "#f4b393", "#d9694f", "#a81529"].map((hex) =>
  [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)),
);

/** x from -1 to 1, beyond it the ends: [red, green, blue] of 255. */
export function divergingColour(x) {
  const at = ((Math.max(-1, Math.min(1, x)) + 1) / 2) * (divergingStops.length - 1);
  const k = Math.min(divergingStops.length - 2, Math.floor(at));
  return divergingStops[k].map((c, i) => Math.round(c + (at - k) * (divergingStops[k + 1][i] - c)));
}

export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;

/** Of text on that colour. */
export const inkOn = ([r, g, b]) => (0.299 * r + 0.587 * g + 0.114 * b > 140 ? "#1a2027" : "#ffffff");

/** What the style sheet calls --name. */
export const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** "#rrggbb" as [r, g, b] of 1. */
export const unitColour = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
