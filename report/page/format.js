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
    const power = [...String(Number(exponent))].map((c) => superscripts[c]).join("");
    return minus(`${Number(mantissa)} × 10`) + power;
  }
  return minus(String(Number(x.toPrecision(digits))));
}

/** So many places behind the point. */
const fixed = (x, places) => (isNumber(x) ? minus(x.toFixed(places)).replace(/^−(0(?:\.0*)?)$/, "$1") : "–");
const signed = (x, places) => (isNumber(x) ? (x > 0 && Number(x.toFixed(places)) > 0 ? "+" : "") + fixed(x, places) : "–");
const percent = (x) => (isNumber(x) ? minus(String(Math.round(100 * x))) + " %" : "–");
const withUnit = (text, unit) => (unit && unit !== "1" ? `${text} ${unit}` : text);
/** "1.0 × 10⁶ (0.9 × 10⁶ … 1.1 × 10⁶) g/(cm² s²)" */
const interval = (a) => withUnit(`${number(a.value)} (${number(a.lower)} … ${number(a.upper)})`, unitText(a.unit));
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
  const what = [effect.name, effect.parameter && !String(effect.parameter).startsWith(effect.name) ? effect.parameter : null];
  return words(what.filter(Boolean).join(" ")) + (effect.where ? ` · ${words(effect.where)}` : "");
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
