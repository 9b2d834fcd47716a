function bytesOf(text) {
  const raw = atob(text),
    bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

/** Places in mm, three numbers a point. */
const placesOf = (text, quantum) => Float32Array.from(new Int16Array(bytesOf(text)), (i) => i * quantum);

/** Distances in mm; NaN where nothing was measured. */
const distancesOf = (text, quantum) =>
  Float32Array.from(new Int16Array(bytesOf(text)), (i) => (i === -32768 ? NaN : i * quantum));

/** The numbers of the report's `wall`, unpacked once. */
export function unpackedWall(wall) {
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
        states: moment.states.map((s) => ({
          positions: placesOf(s.positions, wall.place_quantum),
          distances: distancesOf(s.distances, wall.distance_quantum),
        })),
      })),
    })),
  };
}
