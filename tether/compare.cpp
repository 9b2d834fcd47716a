#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/config/input_watch.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/comparison/compared_wall.hpp"
#include "diagnosis/comparison/comparison_result.hpp"
#include "diagnosis/comparison/comparison_text.hpp"
#include "diagnosis/comparison/finished_run.hpp"
#include "diagnosis/evidence/stored_run.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "report/drawings/comparison_drawings.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// A case with its measurements.
struct MeasuredCase : ObservedCase {
  explicit MeasuredCase(const fs::path& path)
      : ObservedCase(path), surface(lumen()), data(load_observations(observations, surface, file)) {
    if (data.all().empty()) throw input_error("{}: names nothing that was measured", file.where("observations"));
  }
  LumenSurface surface;
  Observations data;
};

/// The column that a trace is compared with. Throws InputError if it is in another unit.
RunTrace trace_of(const CsvTable& table, const Trace& trace, const CaseFile& file) {
  const std::string unit = table.unit(trace.observable), stated = file.units().symbol(trace.dimension);
  if (unit != stated)
    throw input_error("{}: {} is in {}, the measurement in {}: is its quantity right?",
                      file.where("observations.traces." + trace.name + ".observable"), trace.observable,
                      unit.empty() ? "1" : unit, stated);
  return {table.numbers("time"), table.numbers(trace.observable), unit};
}

/// The velocity that the run recorded, if any was measured.
RunVelocity velocity_of(const FinishedRun& run, const MeasuredCase& measured) {
  if (!run.velocity) return {};
  return {run.velocity->times().front(), run.velocity->times().back(),
          [&run](double time) { return run.velocity->vectors_at(time); },
          measured.file.units().symbol(dimension::velocity)};
}

Comparison comparison_of(const MeasuredCase& measured, const FinishedRun& run, const RunMotion& motion,
                         const fs::path& output) {
  const CsvTable table(output / "timeseries.csv", TableOf::tether);
  Comparison comparison = compare(
      measured.data, measured.data.regions,
      {motion, [&](const Trace& trace) { return trace_of(table, trace, measured.file); }, velocity_of(run, measured),
       measured.data.others.empty() ? FinishedMotion{} : StoredRun(output).motion()},
      measured.file.units());
  const CommonCase& common = measured.file.common();
  comparison.run = {common.name, common.title, output.string(), run.steps, motion.start, motion.end, run.observer_gain};
  return comparison;
}

std::vector<std::string> draw(const DrawnComparison& drawn) {
  fs::create_directories(drawn.output / "plots");
  std::vector<std::string> all;
  for (const auto& drawing : {draw_distances, draw_slices, draw_walls})
    for (std::string& name : drawing(drawn)) all.push_back(std::move(name));
  return all;
}

std::string where_figures_are(const fs::path& output, const std::vector<std::string>& pictures) {
  std::string text = fmt::format(
      "In {}:\n  comparison.json    all figures, per source, time, slice and region\n"
      "  comparison.csv     the lumen's as a table; comparison_blood.csv those of traces and velocities\n"
      "  wall.json          the moving lumen and its distance to the measurements at every node\n",
      output.string());
  for (const std::string& name : pictures) text += fmt::format("  plots/{}\n", name);
  return text;
}

}  // namespace

Made<ComparisonResult> compare(const CommandLine& command) {
  check_case(command);
  const InputWatch inputs(command.case_file);
  const MeasuredCase measured(command.case_file);
  const fs::path output = output_of(command, measured.file);
  check_keeps_inputs(output, command.case_file);
  hold_output(output);
  provide_run(command, measured.file, output, measured.data.points());
  const FinishedRun run(output);
  const RunMotion motion = motion_of(run, measured.surface);
  const Comparison comparison = comparison_of(measured, run, motion, output);
  inputs.check();
  ComparisonResult result = result_of(comparison);
  write_record(output / "comparison.json", result);
  write_record(output / "wall.json",
               compared_wall(comparison.sources, measured.data, measured.surface, motion, measured.file.units()));
  write_csv(output / "comparison.csv", comparison);
  write_blood_csv(output / "comparison_blood.csv", comparison);
  const auto pictures = draw({comparison, measured.data, measured.surface, motion, output});
  return {std::move(result), text_of(comparison) + where_figures_are(output, pictures)};
}

}  // namespace tether
