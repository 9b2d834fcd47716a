import { element, section, tabs } from "../base/elements.js";
import { effectName } from "../base/names.js";
import { fixed, isNumber } from "../base/numbers.js";
import { colourBar } from "../charts/colour_bar.js";
import { heatMap } from "../charts/heat_map.js";

export function lookAlikeSection(report) {
  const matrices = report.diagnoses.filter(
    (d) => Array.isArray(d.diagnosis.look_alike) && d.diagnosis.look_alike.length > 1,
  );
  if (!matrices.length) return null;
  const drawn = (diagnosis) => {
    const cosines = diagnosis.look_alike,
      effects = diagnosis.effects.slice(0, cosines.length);
    const values = cosines.map((row, i) =>
      row.map((c, j) =>
        isNumber(c)
          ? {
              value: c,
              text: fixed(c, 2).replace("0.", "."),
              tip:
                i === j
                  ? effectName(effects[i])
                  : `${effectName(effects[i])}\n${effectName(effects[j])}\ncosine ${fixed(c, 2)}`,
            }
          : null,
      ),
    );
    return element(
      "div",
      {},
      heatMap({
        rows: effects.map((e, i) => `${i + 1}  ${effectName(e)}`),
        columns: effects.map((_, i) => String(i + 1)),
        values,
        range: 1,
        square: true,
      }),
      element("div", { class: "scale" }, colourBar(1, "", "opposite", "the same")),
    );
  };
  return section(
    "look-alikes",
    "What looks alike",
    "How similar the strongest candidates' effects on the measurements are. A cosine of 1: both change the model in the same way, and no analysis of these data can tell them apart; a further measurement could. Above 0.9 they are reported as a group. Near 0: independent.",
    ...tabs(matrices.map((d) => ({ label: d.label || "candidates", show: () => drawn(d.diagnosis) }))),
  );
}
