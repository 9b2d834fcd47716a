"use strict";
// Charts as SVG: drawn for the width that they have, and drawn anew when it changes.

/** An element that holds draw(width) and follows its own width. */
function responsive(draw) {
  const host = element("div", { class: "chart" });
  let drawn = 0;
  const redraw = () => {
    const width = Math.floor(host.clientWidth);
    if (width < 40 || width === drawn) return;
    drawn = width;
    host.replaceChildren(draw(width));
  };
  new ResizeObserver(redraw).observe(host);
  requestAnimationFrame(redraw);
  return host;
}

/** A linear or logarithmic way from values to places. */
function scaleOf(low, high, from, to, logarithmic = false) {
  const f = logarithmic ? Math.log10 : (x) => x;
  const a = f(low), b = f(high);
  const scale = (x) => from + ((to - from) * (f(x) - a)) / (b - a || 1);
  return Object.assign(scale, { low, high, logarithmic });
}

/** Round values within a scale, about so many. */
function ticksOf(scale, count = 5) {
  if (scale.logarithmic) {
    const first = Math.ceil(Math.log10(scale.low) - 1e-9), last = Math.floor(Math.log10(scale.high) + 1e-9);
    const stride = Math.max(1, Math.ceil((last - first + 1) / count));
    const decades = Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i)).filter((_, i) => i % stride === 0);
    if (decades.length >= 2) return decades;
    const all = [];
    for (let power = first - 1; power <= last; ++power) for (const m of [1, 2, 3, 5]) all.push(m * 10 ** power);
    return all.filter((x) => x >= scale.low * 0.999 && x <= scale.high * 1.001);
  }
  const raw = (scale.high - scale.low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= raw * 0.999);
  const ticks = [];
  for (let x = Math.ceil(scale.low / step - 1e-9) * step; x <= scale.high + 1e-9 * step; x += step) ticks.push(Math.abs(x) < step * 1e-9 ? 0 : x);
  return ticks;
}

const line = (x1, y1, x2, y2, attributes = {}) => shape("line", { x1, y1, x2, y2, ...attributes });
const label = (x, y, text, attributes = {}) => shape("text", { x, y, ...attributes }, text);
const pathOf = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** An axis below: ticks, numbers, and what it is. */
function axisBelow(svg, x, top, bottom, title, text = (v) => number(v)) {
  const [left, right] = [x(x.low), x(x.high)];
  for (const tick of ticksOf(x, Math.max(2, Math.floor((right - left) / 75)))) {
    svg.append(line(x(tick), top, x(tick), bottom, { class: "grid" }));
    svg.append(label(x(tick), bottom + 16, text(tick), { "text-anchor": "middle" }));
  }
  svg.append(line(left, bottom, right, bottom, { class: "axis" }));
  if (title) svg.append(label((left + right) / 2, bottom + 34, title, { "text-anchor": "middle" }));
}

function axisLeft(svg, y, left, right, title, text = (v) => number(v)) {
  const [bottom, top] = [y(y.low), y(y.high)];
  for (const tick of ticksOf(y, Math.max(2, Math.floor((bottom - top) / 42)))) {
    svg.append(line(left, y(tick), right, y(tick), { class: "grid" }));
    svg.append(label(left - 8, y(tick) + 4, text(tick), { "text-anchor": "end" }));
  }
  if (title) svg.append(label(0, top - 12, title));
}

/** Keys of a legend: [{text, mark: "bar"|"rule"|"dashed"|"dot"|"ring", colour}]. */
function legend(keys) {
  const mark = { bar: "", rule: "rule", dashed: "rule dashed", dot: "dot", ring: "dot" };
  return element("div", { class: "legend" }, keys.filter(Boolean).map((key) =>
    element("span", { class: "key" }, element("i", { class: mark[key.mark] || "", style: key.mark === "bar" ? `background:${key.colour}` : key.mark === "ring" ? `border-color:${key.colour}` : `border-color:${key.colour};${key.mark === "dot" ? `background:${key.colour}` : ""}` }), key.text)));
}

/**
 * Bars per row, several a row, with a mark for a yardstick.
 * rows: [{name, bars: [{value, colour, tip, text}], mark: {value, tip}}]; guide: {value, text}; unit of the axis.
 */
function barChart({ rows, title, guide, high }) {
  return responsive((width) => {
    const left = Math.min(120, width * 0.28), right = width - 92, thick = 13, gap = 16;
    const heights = rows.map((row) => row.bars.length * (thick + 3) + gap);
    const top = 20, bottom = top + heights.reduce((a, b) => a + b, 0);
    const svg = shape("svg", { width, height: bottom + 42, role: "img", "aria-label": title });
    const x = scaleOf(0, high, left, right);
    axisBelow(svg, x, top - 6, bottom, title);
    if (guide) {
      svg.append(line(x(guide.value), top - 6, x(guide.value), bottom, { stroke: "var(--noise)", "stroke-width": 1.5, "stroke-dasharray": "4 3" }));
      svg.append(label(x(guide.value), top - 10, guide.text, { "text-anchor": "middle", style: "fill:var(--noise)" }));
    }
    let y = top + gap / 2;
    rows.forEach((row, i) => {
      svg.append(label(left - 10, y + (heights[i] - gap) / 2 + 3, row.name, { "text-anchor": "end", class: i === 0 ? "strong" : "" }));
      const begun = y;
      for (const bar of row.bars) {
        svg.append(shape("rect", { x: left, y, width: Math.max(1, x(Math.min(bar.value, high)) - left), height: thick, rx: 2, fill: bar.colour, tip: bar.tip, class: "focus" }));
        const beside = x(bar.value) + 8, mark = row.mark ? x(row.mark.value) : 0;
        const hidesMark = mark > beside - 5 && mark < beside + 6.4 * bar.text.length + 5;
        svg.append(label(hidesMark ? mark + 8 : beside, y + thick - 2.5, bar.text));
        y += thick + 3;
      }
      if (row.mark) svg.append(line(x(row.mark.value), begun - 2, x(row.mark.value), y - 1, { stroke: "var(--yardstick)", "stroke-width": 3, tip: row.mark.tip }));
      y += gap;
    });
    return svg;
  });
}

/**
 * A heat map on the diverging scale. rows, columns: names; values[row][column]: {value, text, tip} or null;
 * marked[column]: below it a mark.
 */
function heatMap({ rows, columns, values, range, axis, marked, square = false }) {
  return responsive((width) => {
    const left = Math.min(square ? 250 : 110, width * 0.36);
    const cell = (width - left - 4) / columns.length;
    const tall = square ? Math.min(34, Math.max(16, cell)) : 34;
    const head = square ? 26 : 4, bottom = head + rows.length * tall;
    const svg = shape("svg", { width, height: bottom + (axis ? 48 : 6), role: "img", "aria-label": axis || "matrix" });
    rows.forEach((row, i) => {
      const room = Math.floor(left / 6.4);
      svg.append(label(left - 8, head + i * tall + tall / 2 + 4, row.length > room ? row.slice(0, room - 1) + "…" : row, { "text-anchor": "end", tip: row.length > room ? row : null }));
      columns.forEach((column, j) => {
        const one = values[i][j];
        const colour = one && isNumber(one.value) ? divergingColour(one.value / range) : null;
        svg.append(shape("rect", { x: left + j * cell, y: head + i * tall, width: cell - 1, height: tall - 1, rx: 2, fill: colour ? css(colour) : "var(--wash)", tip: one ? one.tip : null, class: "focus" }));
        if (colour && one.text && cell > 7 * one.text.length + 2)
          svg.append(label(left + (j + 0.5) * cell, head + i * tall + tall / 2 + 4, one.text, { "text-anchor": "middle", style: `fill:${inkOn(colour)};pointer-events:none;font-size:11.5px` }));
      });
    });
    const stride = Math.max(1, Math.ceil((square ? 20 : 40) / cell));
    columns.forEach((column, j) => {
      const x = left + (j + 0.5) * cell;
      if (square) svg.append(label(x, head - 9, String(j + 1), { "text-anchor": "middle" }));
      if (marked && marked[j]) svg.append(shape("circle", { cx: x, cy: bottom + 6, r: 3, fill: "none", stroke: "var(--soft)", "stroke-width": 1.5 }));
      if (axis && j % stride === 0) svg.append(label(x, bottom + 24, column, { "text-anchor": "middle" }));
    });
    if (axis) svg.append(label(left + (columns.length * cell) / 2, bottom + 42, axis, { "text-anchor": "middle" }));
    return svg;
  });
}

/**
 * Lines over time with bands. series: [{time, value, lower, upper, colour}]; logarithmic: of the values;
 * marks: [{value, text}] as level lines.
 */
function bandChart({ series, title, logarithmic = false, marks = [], height = 220 }) {
  return responsive((width) => {
    const left = 74, right = width - 12, top = 30, bottom = height - 44;
    const svg = shape("svg", { width, height, role: "img", "aria-label": title });
    const all = series.flatMap((s) => [...(s.lower || s.value), ...(s.upper || s.value)]).concat(marks.map((m) => m.value)).filter((v) => isNumber(v) && (!logarithmic || v > 0));
    let low = Math.min(...all), high = Math.max(...all);
    if (!logarithmic) [low, high] = [low - 0.06 * (high - low), high + 0.06 * (high - low)];
    if (low === high) [low, high] = [low - 1, high + 1];
    const times = series.flatMap((s) => s.time);
    const x = scaleOf(Math.min(...times), Math.max(...times), left, right), y = scaleOf(low, high, bottom, top, logarithmic);
    axisLeft(svg, y, left, right, title);
    axisBelow(svg, x, top, bottom, "time [s]");
    const clip = (v) => y(Math.min(high, Math.max(low, v)));
    for (const s of series) {
      const up = s.time.map((t, i) => [x(t), clip(s.upper[i])]), down = s.time.map((t, i) => [x(t), clip(s.lower[i])]).reverse();
      svg.append(shape("path", { d: pathOf([...up, ...down]) + "Z", fill: s.colour, opacity: 0.18 }));
      svg.append(shape("path", { d: pathOf(s.time.map((t, i) => [x(t), clip(s.value[i])])), fill: "none", stroke: s.colour, "stroke-width": 2 }));
    }
    for (const mark of marks) {
      svg.append(line(left, y(mark.value), right, y(mark.value), { stroke: "var(--faint)", "stroke-dasharray": "4 3" }));
      svg.append(label(right - 4, y(mark.value) + 14, mark.text, { "text-anchor": "end", class: "faint" }));
    }
    return svg;
  });
}
