// The measured contours, or cuts of the measured surface, as lines of a width in pixels.

export const dataLineColour = "#ffd23f";
export const dataLineEdge = "#20262d";

const corners = [
  [0, -1],
  [0, 1],
  [1, -1],
  [1, 1],
];

/** Each piece of a line as two triangles: for each of their corners both ends of the piece, and which corner it is. */
export function piecesOf(lines) {
  const here = [],
    there = [],
    corner = [],
    pieces = [];
  for (const points of lines)
    for (let i = 0; i + 5 < points.length; i += 3) {
      const first = here.length / 3;
      for (const c of corners) {
        here.push(...points.slice(i, i + 3));
        there.push(...points.slice(i + 3, i + 6));
        corner.push(...c);
      }
      pieces.push(first, first + 1, first + 2, first + 1, first + 3, first + 2);
    }
  return { here, there, corner, pieces };
}
