// The plots that a run left in its folder, as they are.
import { element, section } from "../base/elements.js";
import { words } from "../base/numbers.js";

function figure({ name, png }) {
  const image = element("img", { src: `data:image/png;base64,${png}`, alt: words(name) });
  return element("figure", { class: "plot" }, image, element("figcaption", {}, words(name)));
}

export function plotSection({ plots }) {
  if (!plots.length) return null;
  return section("plots", "The run", "Pressures are absolute.", plots.map(figure));
}
