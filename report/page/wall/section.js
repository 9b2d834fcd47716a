// The moving lumen in 3-D, before and after side by side: one camera, one colour scale, one time. Plain WebGL.
import { section, tabs } from "../base/elements.js";
import { words } from "../base/numbers.js";
import { WallPanel } from "./panel.js";
import { unpackedWall } from "./unpacked.js";

/** What is shown of each run beside its wall: its name, its distances from that source. */
const runsOf = ({ runs }, index) =>
  runs.map(({ label, mm, comparison }) => ({ label, mm, source: comparison.sources[index] }));

export function wallSection(report) {
  if (!report.wall) return null;
  const wall = unpackedWall(report.wall);
  const sources = wall.sources.filter((s) => s.moments.length);
  if (!sources.length) return null;
  return section(
    "wall",
    "The moving wall",
    "The inner surface of the vessel as simulated, coloured by its signed distance to the data at the same moment.",
    ...tabs(
      sources.map((source) => ({
        label: words(source.name),
        show: () => new WallPanel(wall, source, runsOf(report, wall.sources.indexOf(source))).node,
      })),
    ),
  );
}
