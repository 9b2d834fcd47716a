// Charts are SVG: drawn for the width that they have, and drawn anew when it changes.
import { element } from "../base/elements.js";

/** An element that holds draw(width) and follows its own width. */
export function responsive(draw) {
  const host = element("div", { class: "chart" });
  let drawn = 0;
  const redraw = () => {
    const width = Math.floor(host.clientWidth);
    if (width < 40 || width === drawn) return;
    drawn = width;
    host.replaceChildren(draw(width));
  };
  const soon = () => requestAnimationFrame(redraw); // not within the observer: drawing changes what it observes
  new ResizeObserver(soon).observe(host);
  soon();
  return host;
}
