import { cross, dot, longestAxis, unit } from "./vectors.js";

/** Turns, zooms and shifts; the same for all views. At first the worst place of the first run faces the viewer. */
export class Camera {
  constructor(positions, distances) {
    this.centre = [0, 1, 2].map((k) => {
      let low = Infinity,
        high = -Infinity;
      for (let i = k; i < positions.length; i += 3)
        [low, high] = [Math.min(low, positions[i]), Math.max(high, positions[i])];
      return (low + high) / 2;
    });
    this.up = longestAxis(positions, this.centre);
    const toward = [0, 0, 0];
    for (let i = 0; i < distances.length; ++i) {
      if (!(Math.abs(distances[i]) > 0)) continue;
      const d = [0, 1, 2].map((k) => positions[3 * i + k] - this.centre[k]),
        along = dot(d, this.up);
      unit(d.map((x, k) => x - along * this.up[k])).forEach((x, k) => (toward[k] += distances[i] ** 2 * x));
    }
    const side = Math.hypot(...toward) > 0 ? toward : [0.6, -0.8, 0];
    this.right = unit(cross(this.up, side));
    this.front = cross(this.right, this.up);
    let tall = 0,
      wide = 0;
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
    const x = mix(cy, 0, -sy),
      y = mix(-sp * sy, cp, -sp * cy),
      z = mix(cp * sy, sp, cp * cy);
    const size = this.zoom * Math.min(height / 2 / this.tall, width / 2 / this.wide);
    const row = (axis, by, at) => [...axis.map((a) => a * by), -dot(axis, this.centre) * by + at];
    const rows = [
      row(x, (2 * size) / width, this.shift[0]),
      row(y, (2 * size) / height, this.shift[1]),
      row(z, -1 / (3 * this.radius), 0),
      [0, 0, 0, 1],
    ];
    return Float32Array.from({ length: 16 }, (_, i) => rows[i % 4][Math.floor(i / 4)]);
  }
}
