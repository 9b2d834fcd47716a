import { words } from "./numbers.js";

/** What an effect is called: "visco elastic stiffness at spine". */
export function effectName(effect) {
  const what = [
    effect.name,
    effect.parameter && !String(effect.name).endsWith(effect.parameter) ? effect.parameter : null,
  ];
  return words(what.filter(Boolean).join(" ")) + (effect.where ? ` · ${words(effect.where)}` : "");
}

/** The same of an entry whose parameter is named by its place in the case. */
export function placedName(entry) {
  const last = String(entry.parameter || "")
    .split(".")
    .pop();
  return effectName({ ...entry, parameter: String(entry.name).includes(last) ? null : last });
}
