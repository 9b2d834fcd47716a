// Elements of the page. Text from the data enters it only as text nodes, never as markup.

/** An element: element("p", {class: "note", tip: "..."}, "text", child, ...). Nothing is made of null and undefined. */
export function element(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** The same of SVG. */
export function shape(name, attributes = {}, ...children) {
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

/** A card of the page. */
export function section(id, title, lead, ...content) {
  return element(
    "section",
    { id },
    element("h2", {}, title),
    lead ? element("p", { class: "lead" }, lead) : null,
    ...content,
  );
}

/** Buttons of which one is on. choices: [{label, show}], show returns what is then seen. */
export function tabs(choices) {
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
