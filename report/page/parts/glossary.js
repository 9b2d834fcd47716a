import { element, section } from "../base/elements.js";

const glossary = [
  [
    "signed distance",
    "From the model's inner wall to the imaged one, along the normal. Positive: the data lie outside the model, which is too far inward.",
  ],
  ["root mean square (rms)", "The typical distance: squared, averaged over the wall, root taken."],
  [
    "noise, σ",
    "Standard deviation of a single measured distance, as the case states it. Distances in σ say how many times the noise they are.",
  ],
  [
    "sigma, in sentences",
    "Of a mean over a region and a span of time: how many of its own standard deviations it is off. These are far smaller than that of a single distance.",
  ],
  ["held-out frames", "Images that were kept away from the model. An improvement there is not one of fitting."],
  [
    "z",
    "Evidence in standard deviations: beyond 3 or so it is hard to believe in chance, before correcting for many candidates.",
  ],
  ["q", "Probability of such evidence by chance, corrected for having asked about many candidates."],
  ["95 % interval", "Range that holds the true value in 95 of 100 such analyses, if noise and model are as stated."],
  ["yardstick", "How much the vessel itself moves in the images. The error of a model that stands still."],
  [
    "first order",
    "Estimated from how the model responds to a small change, before runs at full size have confirmed it.",
  ],
];

export function glossarySection() {
  const part = section(
    "glossary",
    "Words",
    null,
    element(
      "dl",
      {},
      glossary.flatMap(([term, meaning]) => [element("dt", {}, term), element("dd", {}, meaning)]),
    ),
  );
  part.classList.add("quiet");
  return part;
}
