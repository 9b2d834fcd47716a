import { fixed, millimetres, words } from "../base/numbers.js";

// How far model and data are apart: per region over all frames, and per region and moment.

/** Of the model as given, the best one, and that with a force without a law. */
export const runColour = (i, count) =>
  count === 1 ? "var(--after)" : ["var(--before)", "var(--after)", "var(--noise)"][i];

export const allRegions = (group) => group.region === null;

export const regionLabel = (group) => (allRegions(group) ? "whole wall" : words(group.region));

/** "0.38 mm · 2.5 σ" */
export function distanceText(group, mm, key = "l2") {
  const noise = group.in_noise ? ` · ${fixed(group.in_noise[key], 1)} σ` : "";
  return `${millimetres(mm * group[key])} mm${noise}`;
}

/** The group of another run, of the same region. */
export const sameRegion = (groups, group) => groups.find((g) => g.region === group.region);
