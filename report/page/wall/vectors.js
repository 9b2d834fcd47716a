/** Unit normals at nodes, by the areas of their triangles. */
export function normalsOf(positions, triangles) {
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]),
      v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    const n = cross(u, v);
    for (const node of [a, b, c]) for (let k = 0; k < 3; ++k) normals[node + k] += n[k];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= size;
  }
  return normals;
}

export const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];

export const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];

export const unit = (u) => u.map((x) => x / (Math.hypot(...u) || 1));

/** The direction in which the points extend most, by power iteration; upward if it is steep. */
export function longestAxis(points, centre) {
  const covariance = [0, 0, 0, 0, 0, 0, 0, 0, 0];
  for (let i = 0; i < points.length; i += 3) {
    const d = [0, 1, 2].map((k) => points[i + k] - centre[k]);
    for (let r = 0; r < 3; ++r) for (let c = 0; c < 3; ++c) covariance[3 * r + c] += d[r] * d[c];
  }
  let axis = [0.3, 0.4, 0.86];
  for (let i = 0; i < 60; ++i)
    axis = unit(
      [0, 1, 2].map(
        (r) => covariance[3 * r] * axis[0] + covariance[3 * r + 1] * axis[1] + covariance[3 * r + 2] * axis[2],
      ),
    );
  return axis[2] < 0 ? axis.map((x) => -x) : axis;
}
