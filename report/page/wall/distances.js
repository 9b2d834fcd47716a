// Distances over the wall, by source and moment.
import { niceAbove } from "../charts/axes.js";
import { allRegions } from "../parts/groups.js";

const measured = (state) => Array.from(state.distances).filter((d) => !Number.isNaN(d));

function p95(state) {
  const all = measured(state)
    .map(Math.abs)
    .sort((a, b) => a - b);
  return all.length ? all[Math.floor(0.95 * (all.length - 1))] : 0;
}

/** The range of the scale: at every moment of every run at least 95 % of the measured places are on it. */
export const rangeOf = (source) => niceAbove(Math.max(...source.moments.flatMap((m) => m.states.map(p95))));

function meanSquare(state) {
  const all = measured(state);
  return all.length ? all.reduce((sum, d) => sum + d * d, 0) / all.length : 0;
}

/** The number of the moment at which the first run is farthest from the data. */
export function worstOf(source) {
  const errors = source.moments.map((m) => meanSquare(m.states[0]));
  return errors.indexOf(Math.max(...errors));
}

/** What comparison.json says of the whole wall at that moment. */
export function momentGroup(source, moment) {
  const same = source.moments.find((m) => Math.abs(m.time - moment.time) < 1e-9 && m.held_out === moment.heldOut);
  return same ? same.groups.find(allRegions) : null;
}
