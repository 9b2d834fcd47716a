import { element } from "../base/elements.js";

/** A slider over so many moments, and a button that plays them; show() is called for each. */
export class Player {
  constructor(count, first, show) {
    Object.assign(this, { count, show, timer: null });
    const range = { min: "0", max: String(count - 1), value: String(first) };
    this.slider = element("input", { type: "range", ...range, "aria-label": "frame", class: "frame" });
    this.slider.addEventListener("input", show);
    this.play = element("button", { type: "button" }, "▶ Play");
    this.play.addEventListener("click", () => this.toggle());
  }

  get moment() {
    return Number(this.slider.value);
  }

  toggle() {
    if (this.timer) clearInterval(this.timer);
    this.timer = this.timer ? null : setInterval(() => this.next(), Math.max(120, 2600 / this.count));
    this.play.textContent = this.timer ? "❚❚ Pause" : "▶ Play";
  }

  next() {
    this.slider.value = String((this.moment + 1) % this.count);
    this.show();
  }
}
