import { element, section, shape } from "../base/elements.js";
import { placedName } from "../base/names.js";
import { isNumber, number, unitText, withUnit } from "../base/numbers.js";
import { axisBelow, label, line, scaleOf } from "../charts/axes.js";
import { responsive } from "../charts/responsive.js";

/** The smallest amount that these data show, over the size that it may have in a patient. */
function detectableChart(list) {
  return responsive((width) => {
    const left = Math.min(270, width * 0.46),
      right = width - 20,
      tall = 24,
      top = 24,
      bottom = top + list.length * tall;
    const svg = shape("svg", { width, height: bottom + 44, role: "img", "aria-label": "detectability" });
    const sizes = list.map((d) => d.in_scale);
    const x = scaleOf(Math.min(0.1, ...sizes) / 1.3, Math.max(10, ...sizes) * 1.3, left, right, true);
    svg.append(
      shape("rect", {
        x: left,
        y: top - 6,
        width: x(1) - left,
        height: bottom - top + 6,
        fill: "var(--good)",
        opacity: 0.09,
      }),
    );
    axisBelow(
      svg,
      x,
      top - 6,
      bottom,
      width < 520
        ? "smallest visible ÷ plausible size"
        : "smallest amount seen with 80 % probability ÷ size that it may have in a patient",
    );
    svg.append(line(x(1), top - 6, x(1), bottom, { stroke: "var(--good)", "stroke-width": 1.5 }));
    svg.append(
      label(x(1) - 6, top - 11, "would be seen", { "text-anchor": "end", style: "fill:var(--good)" }),
      label(x(1) + 6, top - 11, "may go unseen", {}),
    );
    list.forEach((d, i) => {
      const y = top + (i + 0.5) * tall,
        name = placedName(d),
        room = Math.floor(left / 6.3);
      svg.append(
        label(left - 10, y + 4, name.length > room ? name.slice(0, room - 1) + "…" : name, { "text-anchor": "end" }),
      );
      svg.append(line(left, y, x(d.in_scale), y, { stroke: "var(--line)", "stroke-width": 2 }));
      svg.append(
        shape("circle", {
          cx: x(d.in_scale),
          cy: y,
          r: 5,
          fill: d.in_scale <= 1 ? "var(--good)" : "var(--faint)",
          tip: `${name}\nseen from ${withUnit(number(d.value), unitText(d.unit))} on (in the model ${number(d.without)})\n${number(d.in_scale, 2)} of the size that it may have in a patient`,
        }),
      );
    });
    return svg;
  });
}

export function detectableSection(report) {
  const diagnoses = report.diagnoses.map((d) => d.diagnosis);
  const list =
    report.explain && (report.explain.detectable || []).length
      ? report.explain.detectable
      : (diagnoses.at(-1) || {}).detectable || [];
  const drawn = list.filter((d) => isNumber(d.in_scale) && d.in_scale > 0).sort((a, b) => a.in_scale - b.in_scale);
  if (!drawn.length) return null;
  const first = drawn.slice(0, 16),
    rest = drawn.slice(16);
  const blind = list.length - drawn.length;
  return section(
    "detectable",
    "What these data would have shown",
    "A verdict is worth as much as the data can see. For each effect: the smallest amount that these measurements reveal in four of five cases, compared with the size that it may have in a patient. Left of the line it would have been found if it were there.",
    detectableChart(first),
    rest.length ? element("details", {}, element("summary", {}, `${rest.length} more`), detectableChart(rest)) : null,
    blind > 0
      ? element(
          "p",
          { class: "note" },
          `${blind} further candidate${blind > 1 ? "s" : ""} cannot be seen in these data at any size, or no plausible size is known.`,
        )
      : null,
  );
}
