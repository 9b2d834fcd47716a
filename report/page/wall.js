"use strict";
// The moving lumen in 3-D, before and after side by side: one camera, one colour scale, one time. Plain WebGL.

const surfaceVertex = `
attribute vec3 place, normal;
attribute vec2 value;            // (distance over the scale's range, 1), or (0, 0) where nothing was measured
uniform mat4 view;
varying vec3 facing;
varying vec2 measured;
void main() {
  gl_Position = view * vec4(place, 1.0);
  facing = mat3(view) * normal;
  measured = value;
}`;
const surfaceFragment = `
precision mediump float;
uniform sampler2D scale;
uniform vec3 unmeasured;
varying vec3 facing;
varying vec2 measured;
void main() {
  vec3 n = normalize(facing);
  float light = 0.74 + 0.26 * abs(n.z) + 0.06 * n.y;
  vec3 colour = unmeasured;
  if (measured.y > 0.5) colour = texture2D(scale, vec2(0.5 + 0.5 * clamp(measured.x / measured.y, -0.995, 0.995), 0.5)).rgb;
  gl_FragColor = vec4(colour * light, 1.0);
}`;
const lineVertex = `
attribute vec3 here, there;
attribute vec2 corner;           // along the piece: 0 or 1; to its side: -1 or 1
uniform mat4 view;
uniform vec2 pixel;              // size of a pixel in clip space
uniform float wide, nearer;
void main() {
  vec4 a = view * vec4(here, 1.0), b = view * vec4(there, 1.0);
  vec2 along = normalize((b.xy - a.xy) / pixel + vec2(1e-6, 0.0));
  vec4 at = mix(a, b, corner.x);
  gl_Position = at + vec4((vec2(-along.y, along.x) * corner.y + along * (2.0 * corner.x - 1.0) * 0.5) * wide * pixel, -nearer, 0.0);
}`;
const lineFragment = `
precision mediump float;
uniform vec3 colour;
void main() { gl_FragColor = vec4(colour, 1.0); }`;

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

/** Places in mm, three numbers a point. */
const placesOf = (text, quantum) => Float32Array.from(new Int16Array(bytesOf(text)), (i) => i * quantum);
/** Distances in mm; NaN where nothing was measured. */
const distancesOf = (text, quantum) => Float32Array.from(new Int16Array(bytesOf(text)), (i) => (i === -32768 ? NaN : i * quantum));

/** The numbers of the report's `wall`, unpacked once. */
function unpackedWall(wall) {
  return {
    triangles: new Uint32Array(bytesOf(wall.triangles)),
    region: new Int32Array(bytesOf(wall.region)),
    regions: wall.regions,
    sources: wall.sources.map((source) => ({
      name: source.name,
      contours: source.contours,
      moments: source.moments.map((moment) => ({
        time: moment.time,
        heldOut: moment.held_out,
        lines: moment.lines.map((l) => placesOf(l, wall.place_quantum)),
        states: moment.states.map((s) => ({ positions: placesOf(s.positions, wall.place_quantum), distances: distancesOf(s.distances, wall.distance_quantum) })),
      })),
    })),
  };
}

/** Unit normals at nodes, by the areas of their triangles. */
function normalsOf(positions, triangles) {
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]), v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    const n = cross(u, v);
    for (const node of [a, b, c]) for (let k = 0; k < 3; ++k) normals[node + k] += n[k];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= size;
  }
  return normals;
}

const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
const unit = (u) => u.map((x) => x / (Math.hypot(...u) || 1));

/** The direction in which the points extend most, by power iteration; upward if it is steep. */
function longestAxis(points, centre) {
  const covariance = [0, 0, 0, 0, 0, 0, 0, 0, 0];
  for (let i = 0; i < points.length; i += 3) {
    const d = [0, 1, 2].map((k) => points[i + k] - centre[k]);
    for (let r = 0; r < 3; ++r) for (let c = 0; c < 3; ++c) covariance[3 * r + c] += d[r] * d[c];
  }
  let axis = [0.3, 0.4, 0.86];
  for (let i = 0; i < 60; ++i) axis = unit([0, 1, 2].map((r) => covariance[3 * r] * axis[0] + covariance[3 * r + 1] * axis[1] + covariance[3 * r + 2] * axis[2]));
  return axis[2] < 0 ? axis.map((x) => -x) : axis;
}

/** Turns, zooms and shifts; the same for all views. At first the worst place of the first run faces the viewer. */
class Camera {
  constructor(positions, distances) {
    this.centre = [0, 1, 2].map((k) => {
      let low = Infinity, high = -Infinity;
      for (let i = k; i < positions.length; i += 3) [low, high] = [Math.min(low, positions[i]), Math.max(high, positions[i])];
      return (low + high) / 2;
    });
    this.up = longestAxis(positions, this.centre);
    const toward = [0, 0, 0];
    for (let i = 0; i < distances.length; ++i) {
      if (!(Math.abs(distances[i]) > 0)) continue;
      const d = [0, 1, 2].map((k) => positions[3 * i + k] - this.centre[k]), along = dot(d, this.up);
      unit(d.map((x, k) => x - along * this.up[k])).forEach((x, k) => (toward[k] += distances[i] ** 2 * x));
    }
    const side = Math.hypot(...toward) > 0 ? toward : [0.6, -0.8, 0];
    this.right = unit(cross(this.up, side));
    this.front = cross(this.right, this.up);
    let tall = 0, wide = 0;
    for (let i = 0; i < positions.length; i += 3) {
      const d = [0, 1, 2].map((k) => positions[i + k] - this.centre[k]);
      tall = Math.max(tall, Math.abs(dot(d, this.up)));
      wide = Math.max(wide, Math.hypot(dot(d, this.right), dot(d, this.front)));
    }
    Object.assign(this, { tall: tall * 1.12, wide: wide * 1.12, radius: Math.hypot(tall, wide) });
    this.reset();
  }
  reset() {
    Object.assign(this, { yaw: 0.5, pitch: 0.22, zoom: 1, shift: [0, 0] });
  }
  /** Column-major, from mm to clip space of a picture so many pixels wide and high. */
  matrix(width, height) {
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const mix = (a, b, c) => [0, 1, 2].map((k) => a * this.right[k] + b * this.up[k] + c * this.front[k]);
    const x = mix(cy, 0, -sy), y = mix(-sp * sy, cp, -sp * cy), z = mix(cp * sy, sp, cp * cy);
    const size = this.zoom * Math.min(height / 2 / this.tall, width / 2 / this.wide);
    const row = (axis, by, at) => [...axis.map((a) => a * by), -dot(axis, this.centre) * by + at];
    const rows = [row(x, (2 * size) / width, this.shift[0]), row(y, (2 * size) / height, this.shift[1]), row(z, -1 / (3 * this.radius), 0), [0, 0, 0, 1]];
    return Float32Array.from({ length: 16 }, (_, i) => rows[i % 4][Math.floor(i / 4)]);
  }
}

/** One canvas with the lumen of one run. Throws if there is no WebGL. */
class WallView {
  constructor(canvas, wall, camera, range) {
    Object.assign(this, { canvas, wall, camera, range });
    const gl = (this.gl = canvas.getContext("webgl", { antialias: true, alpha: true, preserveDrawingBuffer: true }));
    if (!gl || !gl.getExtension("OES_element_index_uint")) throw new Error("no WebGL");
    this.surface = this.program(surfaceVertex, surfaceFragment);
    this.lines = this.program(lineVertex, lineFragment);
    this.buffers = Object.fromEntries(["place", "normal", "value", "triangles", "here", "there", "corner", "pieces"].map((name) => [name, gl.createBuffer()]));
    this.fill("triangles", wall.triangles, gl.ELEMENT_ARRAY_BUFFER);
    const colours = new Uint8Array(256 * 4);
    for (let i = 0; i < 256; ++i) colours.set([...divergingColour(i / 127.5 - 1), 255], 4 * i);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
    for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, name, value);
    gl.enable(gl.DEPTH_TEST);
  }

  program(vertex, fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
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

  /** Each piece of a line as two triangles. */
  showLines(lines) {
    const here = [], there = [], corner = [], pieces = [];
    for (const points of lines)
      for (let i = 0; i + 5 < points.length; i += 3) {
        const first = here.length / 3, a = [...points.slice(i, i + 3)], b = [...points.slice(i + 3, i + 6)];
        for (const c of [[0, -1], [0, 1], [1, -1], [1, 1]]) here.push(...a), there.push(...b), corner.push(...c);
        pieces.push(first, first + 1, first + 2, first + 1, first + 3, first + 2);
      }
    this.pieceCount = pieces.length;
    for (const [name, numbers] of Object.entries({ here, there, corner })) this.fill(name, Float32Array.from(numbers));
    this.fill("pieces", Uint32Array.from(pieces), this.gl.ELEMENT_ARRAY_BUFFER);
  }

  attribute(program, name, size) {
    const { gl } = this, at = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }

  draw() {
    const { gl, canvas } = this, ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (!width || !height || !this.state) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.view = this.camera.matrix(width, height);
    gl.useProgram(this.surface);
    gl.uniformMatrix4fv(gl.getUniformLocation(this.surface, "view"), false, this.view);
    gl.uniform3fv(gl.getUniformLocation(this.surface, "unmeasured"), unitColour(themeColour("unmeasured")));
    this.attribute(this.surface, "place", 3);
    this.attribute(this.surface, "normal", 3);
    this.attribute(this.surface, "value", 2);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.triangles);
    gl.drawElements(gl.TRIANGLES, this.wall.triangles.length, gl.UNSIGNED_INT, 0);
    if (this.pieceCount && this.withLines) this.drawLines(width, height, ratio);
  }

  drawLines(width, height, ratio) {
    const { gl, lines } = this;
    gl.useProgram(lines);
    gl.uniformMatrix4fv(gl.getUniformLocation(lines, "view"), false, this.view);
    gl.uniform2f(gl.getUniformLocation(lines, "pixel"), 2 / width, 2 / height);
    this.attribute(lines, "here", 3);
    this.attribute(lines, "there", 3);
    this.attribute(lines, "corner", 2);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.pieces);
    gl.depthFunc(gl.LEQUAL);
    for (const [wide, nearer, colour] of [[2.2, 0.006, dataLineEdge], [1.2, 0.009, dataLineColour]]) {
      gl.uniform1f(gl.getUniformLocation(lines, "nearer"), nearer);
      gl.uniform1f(gl.getUniformLocation(lines, "wide"), wide * ratio);
      gl.uniform3fv(gl.getUniformLocation(lines, "colour"), unitColour(colour));
      gl.drawElements(gl.TRIANGLES, this.pieceCount, gl.UNSIGNED_INT, 0);
    }
  }

  /** The node in front that is nearest to a place of the canvas, within 24 pixels; -1 if there is none. */
  nodeAt(x, y) {
    if (!this.view) return -1;
    const { positions } = this.state, m = this.view, w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    let best = -1, depth = Infinity;
    for (let i = 0; i < positions.length; i += 3) {
      const at = (r) => m[r] * positions[i] + m[4 + r] * positions[i + 1] + m[8 + r] * positions[i + 2] + m[12 + r];
      const away = Math.hypot(((at(0) + 1) / 2) * w - x, ((1 - at(1)) / 2) * h - y), z = at(2);
      if (away < 24 && z + away * 0.01 < depth) [best, depth] = [i / 3, z + away * 0.01];
    }
    return best;
  }
}

const dataLineColour = "#ffd23f", dataLineEdge = "#20262d";

/** The range of the scale: at every moment of every run at least 95 % of the measured places are on it. */
function rangeOf(source) {
  const p95 = (state) => {
    const all = Array.from(state.distances).filter((d) => !Number.isNaN(d)).map(Math.abs).sort((a, b) => a - b);
    return all.length ? all[Math.floor(0.95 * (all.length - 1))] : 0;
  };
  return niceAbove(Math.max(...source.moments.flatMap((m) => m.states.map(p95))));
}

/** Drag turns, wheel and two fingers zoom, shift and drag shifts, double click goes back. */
function followPointer(canvas, camera, redraw) {
  const held = new Map();
  let apart = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
    apart = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    held.set(event.pointerId, [event.clientX, event.clientY]);
    if (held.size === 2) {
      const [a, b] = [...held.values()], now = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (apart) camera.zoom = Math.max(0.3, Math.min(20, camera.zoom * (now / apart)));
      apart = now;
    } else if (event.shiftKey) {
      camera.shift[0] += (2 * dx) / canvas.clientWidth;
      camera.shift[1] -= (2 * dy) / canvas.clientHeight;
    } else {
      camera.yaw -= dx * 0.01;
      camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + dy * 0.01));
    }
    redraw();
  });
  const release = (event) => held.delete(event.pointerId);
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey && document.activeElement !== canvas) return;
    event.preventDefault();
    camera.zoom = Math.max(0.3, Math.min(20, camera.zoom * Math.exp(-event.deltaY * 0.0015)));
    redraw();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => {
    camera.reset();
    redraw();
  });
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-0.12, 0, 1], ArrowRight: [0.12, 0, 1], ArrowUp: [0, 0.12, 1], ArrowDown: [0, -0.12, 1], "+": [0, 0, 1.15], "-": [0, 0, 1 / 1.15] }[event.key];
    if (!by) return;
    event.preventDefault();
    camera.yaw += by[0];
    camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + by[1]));
    camera.zoom *= by[2];
    redraw();
  });
}

/** All of one source: the views, the time, the scale. */
function wallPanel(wall, source, runs, index) {
  const range = rangeOf(source);
  const worst = source.moments.reduce((best, m, i) => (meanSquare(m.states[0]) > meanSquare(source.moments[best].states[0]) ? i : best), 0);
  const camera = new Camera(source.moments[worst].states[0].positions, source.moments[worst].states[0].distances);
  const figures = runs.map(() => element("div", { class: "figure" }));
  const canvases = runs.map((run) => element("canvas", { class: "wall", tabindex: "0", "aria-label": `Lumen, ${run.label}, coloured by its signed distance to the data` }));
  const readout = element("div", { class: "readout" }, "Drag to turn, two fingers or click and wheel to zoom, double click to go back. Point at the wall to read its distance.");
  const slider = element("input", { type: "range", min: "0", max: String(source.moments.length - 1), value: String(worst), "aria-label": "frame", class: "frame" });
  const when = element("span", { class: "when" });
  const play = element("button", { type: "button" }, "▶ Play");
  const withLines = element("button", { type: "button", "aria-pressed": "true" }, source.contours ? "measured contours" : "cuts of the measured surface");
  const views = [];

  const redraw = () => views.forEach((view) => view.draw());
  const show = () => {
    const moment = source.moments[Number(slider.value)];
    when.textContent = `${number(moment.time)} s${moment.heldOut ? " · held-out frame" : ""}`;
    views.forEach((view, i) => {
      view.show(moment.states[i], moment.lines);
      const group = momentGroup(runs[i].comparison.sources[index], moment);
      figures[i].textContent = group ? `rms ${distanceText(group, runs[i].mm)}` : "";
    });
  };
  const read = (view, event) => {
    const rect = view.canvas.getBoundingClientRect(), node = view.nodeAt(event.clientX - rect.left, event.clientY - rect.top);
    if (node < 0) return;
    const region = wall.regions[wall.region[node]];
    const texts = views.map((v, i) => {
      const d = v.state.distances[node];
      return `${runs.length > 1 ? runs[i].label + " " : ""}${Number.isNaN(d) ? "not measured here" : `${signed(d, 2)} mm`}`;
    });
    readout.textContent = `${region ? words(region) + ": " : ""}${texts.join(" · ")}`;
  };
  const start = () => {
    try {
      canvases.forEach((canvas) => views.push(Object.assign(new WallView(canvas, wall, camera, range), { withLines: true })));
    } catch (error) {
      stage.replaceChildren(element("p", { class: "note" }, `The moving wall needs WebGL, which this browser does not offer (${error.message}). All figures are in the other parts of this page.`));
      return;
    }
    views.forEach((view) => {
      followPointer(view.canvas, camera, redraw);
      view.canvas.addEventListener("pointermove", (event) => read(view, event));
    });
    new ResizeObserver(redraw).observe(canvases[0]);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
    show();
  };
  let timer = null;
  play.addEventListener("click", () => {
    if (timer) clearInterval(timer);
    timer = timer ? null : setInterval(() => {
      slider.value = String((Number(slider.value) + 1) % source.moments.length);
      show();
    }, Math.max(120, 2600 / source.moments.length));
    play.textContent = timer ? "❚❚ Pause" : "▶ Play";
  });
  slider.addEventListener("input", show);
  withLines.addEventListener("click", () => {
    const on = withLines.getAttribute("aria-pressed") !== "true";
    withLines.setAttribute("aria-pressed", String(on));
    views.forEach((view) => (view.withLines = on));
    redraw();
  });
  const stage = element("div", { class: "walls" }, runs.map((run, i) => element("div", {}, element("div", { class: "caption" }, element("strong", {}, run.label), figures[i]), element("div", { class: "stage" }, canvases[i]))));
  requestAnimationFrame(start);
  return element("div", {}, stage, element("div", { class: "controls" }, play, slider, when, withLines), readout,
    element("div", { class: "scale" }, colourBar(range, "mm", "data inside the model", "data outside the model")),
    legend([{ text: "nothing measured here", mark: "bar", colour: "var(--unmeasured)" }, { text: source.contours ? "measured contours" : "cuts of the measured surface", mark: "rule", colour: dataLineColour }]));
}

function meanSquare(state) {
  let sum = 0, count = 0;
  for (const d of state.distances) if (!Number.isNaN(d)) [sum, count] = [sum + d * d, count + 1];
  return count ? sum / count : 0;
}

/** What comparison.json says of the whole wall at that moment. */
function momentGroup(source, moment) {
  const same = source.moments.find((m) => Math.abs(m.time - moment.time) < 1e-9 && m.held_out === moment.heldOut);
  return same ? same.groups.find(allRegions) : null;
}

function wallSection(report) {
  if (!report.wall) return null;
  const wall = unpackedWall(report.wall);
  const sources = wall.sources.filter((s) => s.moments.length);
  if (!sources.length) return null;
  return section("wall", "The moving wall", "The inner surface of the vessel as simulated, coloured by its signed distance to the data at the same moment.",
    ...tabs(sources.map((source) => ({ label: words(source.name), show: () => wallPanel(wall, source, report.runs, wall.sources.indexOf(source)) }))));
}
