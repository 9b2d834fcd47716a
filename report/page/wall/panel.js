import { element } from "../base/elements.js";
import { number, signed, words } from "../base/numbers.js";
import { colourBar } from "../charts/colour_bar.js";
import { legend } from "../charts/legend.js";
import { distanceText } from "../parts/groups.js";
import { Camera } from "./camera.js";
import { momentGroup, rangeOf, worstOf } from "./distances.js";
import { dataLineColour } from "./lines.js";
import { Player } from "./player.js";
import { followPointer } from "./pointer.js";
import { WallView } from "./view.js";

const usage =
  "Drag to turn, two fingers or click and wheel to zoom, double click to go back. Point at the wall to read its distance.";
const lineName = (source) => (source.contours ? "measured contours" : "cuts of the measured surface");

/** The lumen of one run, with its name and distance above. */
class Stage {
  constructor(run) {
    this.run = run;
    this.figure = element("div", { class: "figure" });
    const name = `Lumen, ${run.label}, coloured by its signed distance to the data`;
    this.canvas = element("canvas", { class: "wall", tabindex: "0", "aria-label": name });
    const caption = element("div", { class: "caption" }, element("strong", {}, run.label), this.figure);
    this.node = element("div", {}, caption, element("div", { class: "stage" }, this.canvas));
  }

  show(moment, state) {
    this.view.show(state, moment.lines);
    const group = momentGroup(this.run.source, moment);
    this.figure.textContent = group ? `rms ${distanceText(group, this.run.mm)}` : "";
  }
}

/** All of one source: a stage for each run, the time, the scale. */
export class WallPanel {
  constructor(wall, source, runs) {
    Object.assign(this, { wall, source, range: rangeOf(source), stages: runs.map((run) => new Stage(run)) });
    const worst = worstOf(source),
      state = source.moments[worst].states[0];
    this.camera = new Camera(state.positions, state.distances);
    this.player = new Player(source.moments.length, worst, () => this.show());
    this.walls = element(
      "div",
      { class: "walls" },
      this.stages.map((stage) => stage.node),
    );
    this.readout = element("div", { class: "readout" }, usage);
    this.when = element("span", { class: "when" });
    this.node = element("div", {}, this.walls, this.controls(), this.readout, this.scale(), this.keys());
    requestAnimationFrame(() => this.start());
  }

  controls() {
    const { play, slider } = this.player;
    return element("div", { class: "controls" }, play, slider, this.when, this.lineButton());
  }

  lineButton() {
    const button = element("button", { type: "button", "aria-pressed": "true" }, lineName(this.source));
    button.addEventListener("click", () => {
      const on = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(on));
      this.stages.forEach(({ view }) => (view.withLines = on));
      this.redraw();
    });
    return button;
  }

  scale() {
    return element(
      "div",
      { class: "scale" },
      colourBar(this.range, "mm", "data inside the model", "data outside the model"),
    );
  }

  keys() {
    return legend([
      { text: "nothing measured here", mark: "bar", colour: "var(--unmeasured)" },
      { text: lineName(this.source), mark: "rule", colour: dataLineColour },
    ]);
  }

  /** When the canvases are in the page. */
  start() {
    try {
      for (const stage of this.stages) stage.view = new WallView(stage.canvas, this.wall, this.camera, this.range);
    } catch (error) {
      const why = `The moving wall needs WebGL, which this browser does not offer (${error.message}). All figures are in the other parts of this page.`;
      this.walls.replaceChildren(element("p", { class: "note" }, why));
      return;
    }
    this.follow();
    this.show();
  }

  follow() {
    const redraw = () => this.redraw();
    for (const { canvas, view } of this.stages) {
      followPointer(canvas, this.camera, redraw);
      canvas.addEventListener("pointermove", (event) => this.read(view, event));
    }
    new ResizeObserver(redraw).observe(this.stages[0].canvas);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  }

  redraw() {
    for (const { view } of this.stages) view?.draw();
  }

  show() {
    const moment = this.source.moments[this.player.moment];
    this.when.textContent = `${number(moment.time)} s${moment.heldOut ? " · held-out frame" : ""}`;
    this.stages.forEach((stage, i) => stage.view && stage.show(moment, moment.states[i]));
  }

  /** The distances at the place under the pointer, in all runs. */
  read(view, event) {
    const { left, top } = view.canvas.getBoundingClientRect(),
      node = view.nodeAt(event.clientX - left, event.clientY - top);
    if (node < 0) return;
    const region = this.wall.regions[this.wall.region[node]];
    const texts = this.stages.map((stage) => this.distanceAt(stage, node));
    this.readout.textContent = `${region ? words(region) + ": " : ""}${texts.join(" · ")}`;
  }

  distanceAt({ run, view }, node) {
    const distance = view.state.distances[node];
    const text = Number.isNaN(distance) ? "not measured here" : `${signed(distance, 2)} mm`;
    return this.stages.length > 1 ? `${run.label} ${text}` : text;
  }
}
