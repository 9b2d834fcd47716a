import { element } from "../base/elements.js";

const marks = { bar: "", rule: "rule", dashed: "rule dashed", dot: "dot", ring: "dot" };

function markStyle({ mark, colour }) {
  if (mark === "bar") return `background:${colour}`;
  return `border-color:${colour};${mark === "dot" ? `background:${colour}` : ""}`;
}

function entry(key) {
  const mark = element("i", { class: marks[key.mark] || "", style: markStyle(key) });
  return element("span", { class: "key" }, mark, key.text);
}

/** Keys of a legend: [{text, mark: "bar"|"rule"|"dashed"|"dot"|"ring", colour}]; nothing is made of null. */
export const legend = (keys) => element("div", { class: "legend" }, keys.filter(Boolean).map(entry));
