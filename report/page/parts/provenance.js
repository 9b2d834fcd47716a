import { costOf, runsOf } from "./tiles.js";
import { element, section } from "../base/elements.js";
import { duration, fixed, isNumber, number, withUnit, words } from "../base/numbers.js";
import { allRegions } from "./groups.js";

// Where all this comes from: cases, runs, files, seeds, cost; and what the words mean.

const sizeText = (bytes) =>
  bytes > 1e6 ? `${fixed(bytes / 1e6, 1)} MB` : bytes > 1e3 ? `${fixed(bytes / 1e3, 0)} kB` : `${bytes} bytes`;

function tableOf(heads, rows) {
  if (!rows.length) return null;
  return element(
    "div",
    { class: "scroll" },
    element(
      "table",
      {},
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          heads.map((h) => element("th", {}, h)),
        ),
      ),
      element(
        "tbody",
        {},
        rows.map((row) =>
          element(
            "tr",
            {},
            row.map((cell) => element("td", {}, cell)),
          ),
        ),
      ),
    ),
  );
}

function runRow(run) {
  const s = run.summary,
    cpu = s.cpu_seconds ? s.cpu_seconds.total : null,
    memory = s.peak_memory_mb ? s.peak_memory_mb.total : null;
  return [
    run.label || "run",
    run.finished,
    `${s.steps} of ${number(s.dt)} s`,
    duration(s.wall_seconds),
    duration(cpu),
    isNumber(memory) ? `${number(memory)} MB` : "–",
    [...new Set(Object.values(s.versions || {}))].join(", "),
  ];
}

/** What was left out of the data, and what was found on loading. */
function dataNotes(report) {
  if (!report.runs.length) return null;
  const lines = report.runs[0].comparison.sources.flatMap((source) => {
    const excluded = {};
    for (const kind of ["training", "held_out"]) {
      const whole = source[kind].all_frames.find(allRegions);
      for (const [why, count] of Object.entries(whole ? whole.excluded : {}))
        excluded[why] = (excluded[why] || 0) + count;
    }
    const noise =
      source.noise.deviation > 0
        ? `noise ${withUnit(fixed(report.runs[0].mm * source.noise.deviation, 2), "mm")}, alike within ${fixed(report.runs[0].mm * source.noise.correlation_length, 1)} mm`
        : "no noise stated";
    const outside = source.frames_outside_the_run.length;
    return [
      `${words(source.name)}: ${source.kind}, ${source.frames} frames${outside ? `, ${outside} outside the run` : ""}; ${noise}.`,
      ...source.notes.map((n) => `${words(source.name)}: ${n}`),
      ...Object.entries(excluded).map(
        ([why, count]) => `${words(source.name)}: ${count} places without a distance: ${why}`,
      ),
    ];
  });
  return element(
    "ul",
    { class: "further" },
    lines.map((l) => element("li", {}, l)),
  );
}

/** Of an explanation, a diagnosis or an estimate; the second does not tell how long it took. */
function costTexts(cost) {
  return [
    isNumber(cost.cpu_seconds) ? `${duration(cost.cpu_seconds)} of CPU` : null,
    "wall_seconds" in cost && isNumber(cost.wall_seconds) ? `${duration(cost.wall_seconds)} of waiting` : null,
  ];
}

/** A file that several fields name stands there once. */
function fileRows(files) {
  const rows = new Map();
  for (const f of files) {
    const row = rows.get(f.name) || { ...f, fields: [], changed: false };
    row.fields.push(f.field);
    row.changed = row.changed || f.changed;
    rows.set(f.name, row);
  }
  return [...rows.values()].map((f) => [
    f.name,
    f.fields.length > 3 ? `${f.fields[0]} and ${f.fields.length - 1} others` : f.fields.join(", "),
    sizeText(f.bytes),
    f.changed ? `${f.modified}: changed since it was read for the run` : f.modified,
  ]);
}

/** By what, when and at what cost. */
function madeText(report) {
  const { version, commit, date } = report.made;
  const runs = runsOf(report),
    cost = costOf(report) || report.estimates[0]?.estimate.cost;
  return [
    `Tether ${version}${commit ? ` (${commit})` : ""}`,
    `page written ${date}`,
    runs ? `${runs} runs` : null,
    ...(cost ? costTexts(cost) : []),
  ].filter(Boolean);
}

export function provenanceSection(report) {
  const p = report.provenance;
  const made = madeText(report);
  const steps = (report.explain ? report.explain.steps || [] : []).map((s) => [
    s.name,
    s.folder,
    duration(s.wall_seconds),
    duration(s.cpu_seconds),
  ]);
  const part = section(
    "provenance",
    "Where this comes from",
    null,
    element("p", {}, made.join(" · ")),
    element("h3", {}, "Data"),
    dataNotes(report),
    tableOf(["file", "named by", "size", "last change"], fileRows(p.files)),
    p.seeds.length
      ? element("p", {}, "Seeds of random numbers: ", p.seeds.map((s) => `${s.field} = ${s.value}`).join(", "))
      : null,
    p.runs.length ? element("h3", {}, "Runs") : null,
    tableOf(["run", "finished", "steps", "time", "CPU", "memory", "programs"], p.runs.map(runRow)),
    steps.length ? element("h3", {}, "Steps") : null,
    tableOf(["step", "folder", "time", "CPU"], steps),
    p.cases.map((c) =>
      element(
        "details",
        {},
        element("summary", {}, `Case file as run${c.label ? `, ${c.label}` : ""}`),
        element("pre", {}, c.text),
      ),
    ),
    report.notes.map((n) => element("p", { class: "note" }, n)),
  );
  part.classList.add("long");
  return part;
}
