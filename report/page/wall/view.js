import { themeColour, unitColour } from "../base/colours.js";
import { bindScale, linkedProgram } from "./gl.js";
import { dataLineColour, dataLineEdge, piecesOf } from "./lines.js";
import { lineFragment, lineVertex, surfaceFragment, surfaceVertex } from "./shaders.js";
import { normalsOf } from "./vectors.js";

/** One canvas with the lumen of one run. Throws if there is no WebGL. */
export class WallView {
  constructor(canvas, wall, camera, range) {
    Object.assign(this, { canvas, wall, camera, range, withLines: true });
    const gl = (this.gl = canvas.getContext("webgl", { antialias: true, alpha: true, preserveDrawingBuffer: true }));
    if (!gl || !gl.getExtension("OES_element_index_uint")) throw new Error("no WebGL");
    this.surface = linkedProgram(gl, surfaceVertex, surfaceFragment);
    this.lines = linkedProgram(gl, lineVertex, lineFragment);
    this.buffers = Object.fromEntries(
      ["place", "normal", "value", "triangles", "here", "there", "corner", "pieces"].map((name) => [
        name,
        gl.createBuffer(),
      ]),
    );
    this.fill("triangles", wall.triangles, gl.ELEMENT_ARRAY_BUFFER);
    bindScale(gl);
    gl.enable(gl.DEPTH_TEST);
  }

  fill(name, numbers, target = this.gl.ARRAY_BUFFER) {
    this.gl.bindBuffer(target, this.buffers[name]);
    this.gl.bufferData(target, numbers, this.gl.DYNAMIC_DRAW);
  }

  /** state: positions and distances; lines: the data's. */
  show(state, lines) {
    this.state = state;
    const values = new Float32Array(2 * state.distances.length);
    state.distances.forEach((d, i) => values.set(Number.isNaN(d) ? [0, 0] : [d / this.range, 1], 2 * i));
    this.fill("place", state.positions);
    this.fill("normal", normalsOf(state.positions, this.wall.triangles));
    this.fill("value", values);
    this.showLines(lines);
    this.draw();
  }

  showLines(lines) {
    const { here, there, corner, pieces } = piecesOf(lines);
    this.pieceCount = pieces.length;
    for (const [name, numbers] of Object.entries({ here, there, corner })) this.fill(name, Float32Array.from(numbers));
    this.fill("pieces", Uint32Array.from(pieces), this.gl.ELEMENT_ARRAY_BUFFER);
  }

  attribute(program, name, size) {
    const { gl } = this,
      at = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }

  /** The canvas as large as it is seen; nothing if it is not, or has nothing to show. */
  fitted() {
    const { canvas } = this,
      ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (!width || !height || !this.state) return null;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    return { width, height, ratio };
  }

  draw() {
    const { gl } = this,
      size = this.fitted();
    if (!size) return;
    gl.viewport(0, 0, size.width, size.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.view = this.camera.matrix(size.width, size.height);
    this.drawSurface();
    if (this.pieceCount && this.withLines) this.drawLines(size);
  }

  drawSurface() {
    const { gl, surface } = this;
    gl.useProgram(surface);
    gl.uniformMatrix4fv(gl.getUniformLocation(surface, "view"), false, this.view);
    gl.uniform3fv(gl.getUniformLocation(surface, "unmeasured"), unitColour(themeColour("unmeasured")));
    this.attribute(surface, "place", 3);
    this.attribute(surface, "normal", 3);
    this.attribute(surface, "value", 2);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.triangles);
    gl.drawElements(gl.TRIANGLES, this.wall.triangles.length, gl.UNSIGNED_INT, 0);
  }

  drawLines({ width, height, ratio }) {
    const { gl, lines } = this;
    gl.useProgram(lines);
    gl.uniformMatrix4fv(gl.getUniformLocation(lines, "view"), false, this.view);
    gl.uniform2f(gl.getUniformLocation(lines, "pixel"), 2 / width, 2 / height);
    this.attribute(lines, "here", 3);
    this.attribute(lines, "there", 3);
    this.attribute(lines, "corner", 2);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.pieces);
    gl.depthFunc(gl.LEQUAL);
    for (const [wide, nearer, colour] of [
      [2.2, 0.006, dataLineEdge],
      [1.2, 0.009, dataLineColour],
    ]) {
      gl.uniform1f(gl.getUniformLocation(lines, "nearer"), nearer);
      gl.uniform1f(gl.getUniformLocation(lines, "wide"), wide * ratio);
      gl.uniform3fv(gl.getUniformLocation(lines, "colour"), unitColour(colour));
      gl.drawElements(gl.TRIANGLES, this.pieceCount, gl.UNSIGNED_INT, 0);
    }
  }

  /** The node in front that is nearest to a place of the canvas, within 24 pixels; -1 if there is none. */
  nodeAt(x, y) {
    if (!this.view) return -1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { positions } = this.state;
    let best = -1,
      depth = Infinity;
    for (let i = 0; i < positions.length; i += 3) {
      const [u, v, z] = projected(this.view, positions, i);
      const away = Math.hypot(((u + 1) / 2) * width - x, ((1 - v) / 2) * height - y);
      if (away < 24 && z + away * 0.01 < depth) [best, depth] = [i / 3, z + away * 0.01];
    }
    return best;
  }
}

const projected = (m, positions, i) =>
  [0, 1, 2].map((r) => m[r] * positions[i] + m[4 + r] * positions[i + 1] + m[8 + r] * positions[i + 2] + m[12 + r]);
