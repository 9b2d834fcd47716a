// The pictures that a run or a diagnosis left in its folder, as they are.
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

/** Where the models diagnosed leave something. */
export function misfitSection({ diagnoses }) {
  const drawn = diagnoses.filter(({ misfit }) => misfit);
  if (!drawn.length) return null;
  return section(
    "misfit",
    "What is left, on the wall",
    "How significant what remains beside the leading explanation is about each place, in deviations. The line: where most remains.",
    drawn.map(({ label, misfit }) => figure({ name: label || "the model", png: misfit })),
  );
}
