"use strict";
// Elements and numbers. Text from the data enters the page only as text nodes, never as markup.

window.addEventListener("error", (event) => {
  const root = document.documentElement;
  root.dataset.errors = (root.dataset.errors ? root.dataset.errors + "\n" : "") + event.message;
});

/** An element: element("p", {class: "note", tip: "..."}, "text", child, ...). Nothing is made of null and undefined. */
function element(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** The same of SVG. */
function shape(name, attributes = {}, ...children) {
  return filled(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

function filled(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined) continue;
    if (key === "tip") {
      node.setAttribute("data-tip", value);
      node.setAttribute("tabindex", "0");
    } else node.setAttribute(key, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

const superscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
const minus = (text) => text.replace(/-/g, "−");
const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

/** "1.02 × 10⁶", "0.38", "12.5": so many significant digits. */
function number(x, digits = 3) {
  if (!isNumber(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
    return minus(`${Number(mantissa)} × `) + powerOfTen(Number(exponent));
  }
  return minus(String(Number(x.toPrecision(digits))));
}

/** So many places behind the point. */
const fixed = (x, places) => (isNumber(x) ? minus(x.toFixed(places)).replace(/^−(0(?:\.0*)?)$/, "$1") : "–");
const signed = (x, places) => (isNumber(x) ? (x > 0 && Number(x.toFixed(places)) > 0 ? "+" : "") + fixed(x, places) : "–");
/** A length in mm: two places, three below a tenth. */
const millimetres = (x) => fixed(x, Math.abs(x) < 0.0995 ? 3 : 2);
const percent = (x) => (isNumber(x) ? minus(String(Math.round(100 * x))) + " %" : "–");
const withUnit = (text, unit) => (unit && unit !== "1" ? `${text} ${unit}` : text);
const powerOfTen = (exponent) => `10${[...String(exponent)].map((c) => superscripts[c]).join("")}`;
/** "1.02 (0.91 … 1.13) × 10⁶ g/(cm² s²)": the same power of ten for all three. */
function interval(a) {
  const exponent = isNumber(a.value) && a.value !== 0 ? Math.floor(Math.log10(Math.abs(a.value))) : 0;
  const common = exponent >= 5 || exponent < -3 ? exponent : 0;
  const [value, lower, upper] = [a.value, a.lower, a.upper].map((x) => (isNumber(x) ? number(x / 10 ** common) : "–"));
  return withUnit(`${value} (${a.at_limit ? "its limit" : `${lower} … ${upper}`})${common ? ` × ${powerOfTen(common)}` : ""}`, unitText(a.unit));
}
/** A sentence of the results as people write numbers, units and names. */
const prose = (sentence) => sentence.replace(/(\d)e([+-]?)0*(\d+)/g, (all, digit, sign, power) => `${digit}\u00a0×\u00a0${powerOfTen((sign === "-" ? "-" : "") + power)}`)
  .replace(/\(([a-z]+[a-z0-9 ]*)\)|(?<=[0-9⁰¹²³⁴⁵⁶⁷⁸⁹] )[a-z]+[0-9]?\/(?:[a-z0-9]+|\([a-z0-9 ]+\))/gi, (unit) => unitText(unit)).replace(/_/g, " ").replace(/ \.\. /g, " … ").replace(/(^|[ (])-(?=\d)/g, "$1−");
/** Powers in a unit: "g/(cm2 s2)" as people write it. */
const unitText = (unit) => (unit || "").replace(/([a-zA-Z])(-?\d)/g, (all, letter, power) => letter + [...power].map((c) => superscripts[c]).join(""));
const words = (name) => String(name ?? "").replace(/_/g, " ");
/** "below 10⁻⁶", "0.012" */
const probability = (p) => (!isNumber(p) ? "–" : p < 1e-6 ? "< 10⁻⁶" : p < 1e-3 ? number(p, 1) : number(p, 2));

function duration(seconds) {
  if (!isNumber(seconds)) return "–";
  if (seconds < 90) return `${number(seconds, 2)} s`;
  if (seconds < 5400) return `${number(seconds / 60, 2)} min`;
  return `${number(seconds / 3600, 2)} h`;
}

/** What an effect is called: "visco elastic stiffness at spine". */
function effectName(effect) {
  const what = [effect.name, effect.parameter && !String(effect.name).endsWith(effect.parameter) ? effect.parameter : null];
  return words(what.filter(Boolean).join(" ")) + (effect.where ? ` · ${words(effect.where)}` : "");
}

/** The same of an entry whose parameter is named by its place in the case. */
function placedName(entry) {
  const last = String(entry.parameter || "").split(".").pop();
  return effectName({ ...entry, parameter: String(entry.name).includes(last) ? null : last });
}

/** A card of the page. */
function section(id, title, lead, ...content) {
  return element("section", { id }, element("h2", {}, title), lead ? element("p", { class: "lead" }, lead) : null, ...content);
}

/** Buttons of which one is on. choices: [{label, show}], show returns what is then seen. */
function tabs(choices) {
  if (choices.length === 1) return [choices[0].show()];
  const panel = element("div");
  const buttons = choices.map((choice, i) => {
    const button = element("button", { type: "button", role: "tab" }, choice.label);
    button.addEventListener("click", () => select(i));
    return button;
  });
  const select = (chosen) => {
    buttons.forEach((button, i) => button.setAttribute("aria-selected", String(i === chosen)));
    panel.replaceChildren(choices[chosen].show());
  };
  select(0);
  return [element("div", { class: "tabs", role: "tablist" }, buttons), panel];
}

/** Explanations under the pointer, or of what has the keyboard's focus. */
function showTips(tip) {
  const hide = () => (tip.hidden = true);
  const show = (target, x, y) => {
    tip.textContent = target.getAttribute("data-tip");
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = `${Math.max(6, Math.min(x + 14, window.innerWidth - box.width - 8))}px`;
    tip.style.top = `${y + 18 + box.height > window.innerHeight ? y - box.height - 10 : y + 18}px`;
  };
  const tipped = (event) => (event.target instanceof Element ? event.target.closest("[data-tip]") : null);
  document.addEventListener("pointermove", (event) => {
    const target = tipped(event);
    target ? show(target, event.clientX, event.clientY) : hide();
  });
  document.addEventListener("focusin", (event) => {
    const target = tipped(event);
    if (!target || !target.matches(":focus-visible")) return hide();
    const box = target.getBoundingClientRect();
    show(target, box.left, box.bottom - 12);
  });
  document.addEventListener("focusout", hide);
  document.addEventListener("scroll", hide, { passive: true });
}
