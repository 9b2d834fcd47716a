#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"
#include "fsi_master/results/periodicity.hpp"
#include "solid/results/rest_state.hpp"

namespace tether {

/// The symbols of a case's units.
struct UnitsUsed {
  static constexpr const char* type_name = "units_used";
  std::string system, length, pressure, flow;

  static void fields(auto& self, auto&& field) {
    field("system", self.system, "cgs, SI or mm-g-s");
    field("length", self.length, "its symbol");
    field("pressure", self.pressure, "its symbol");
    field("flow", self.flow, "its symbol");
  }
};

struct TimeSpan {
  static constexpr const char* type_name = "time_span";
  double start = 0, end = 0;

  static void fields(auto& self, auto&& field) {
    field("start", self.start, "[s]");
    field("end", self.end, "[s]");
  }
};

struct MeanAndMax {
  static constexpr const char* type_name = "mean_and_max";
  double mean = 0, max = 0;

  static void fields(auto& self, auto&& field) {
    field("mean", self.mean, "over the steps");
    field("max", self.max, "of any step");
  }
};

struct PressureRange {
  static constexpr const char* type_name = "pressure_range";
  double min = 0, max = 0;
  std::string unit;
  double min_mmhg = 0, max_mmhg = 0, relative_to_mmhg = 0;

  static void fields(auto& self, auto&& field) {
    field("min", self.min, "[unit]");
    field("max", self.max, "[unit]");
    field("unit", self.unit, "symbol");
    field("min_mmHg", self.min_mmhg, "[mmHg]");
    field("max_mmHg", self.max_mmhg, "[mmHg]");
    field("relative_to_mmHg", self.relative_to_mmhg, "the pressure in the image, at which these are zero [mmHg]");
  }
};

struct FollowedPoint {
  static constexpr const char* type_name = "followed_point";
  int interface_node = 0;
  double distance_to_node = 0;

  static void fields(auto& self, auto&& field) {
    field("interface_node", self.interface_node, "that stands for the point");
    field("distance_to_node", self.distance_to_node, "[length]");
  }
};

/// How the interfaces of fluid and wall fit, and what got lost between them.
struct InterfaceRecord {
  static constexpr const char* type_name = "interface_record";
  std::string mapping;
  std::int64_t fluid_nodes = 0, wall_nodes = 0;
  double largest_gap_mm = 0, largest_overlap_mm = 0, rms_distance_mm = 0, bare_share = 0;
  double force_error = 0, moment_error = 0, work_error = 0;

  static void fields(auto& self, auto&& field) {
    field("mapping", self.mapping, "match, mortar or nearest_triangle");
    field("fluid_nodes", self.fluid_nodes, "of its interface");
    field("wall_nodes", self.wall_nodes, "of its interface");
    field("largest_gap_mm", self.largest_gap_mm, "wall outside the fluid's surface, at a fluid node [mm]");
    field("largest_overlap_mm", self.largest_overlap_mm, "wall inside it [mm]");
    field("rms_distance_mm", self.rms_distance_mm, "of the fluid's nodes from the wall [mm]");
    field("bare_share", self.bare_share, "of the wall's area, where no load of the fluid reaches it");
    field("force_error", self.force_error, "largest difference of the sums over both sides, to the sum of sizes");
    field("moment_error", self.moment_error, "the same of moments, at the places of the image");
    field("work_error", self.work_error, "the same of work");
  }
};

/// What a state observer did: the run follows the data, and is no evidence for the model.
struct ObserverWork {
  static constexpr const char* type_name = "observer_work";
  double gain = 0;
  std::int64_t corrections = 0, weakened = 0;
  double largest_correction = 0, largest_correction_mm = 0;

  static void fields(auto& self, auto&& field) {
    field("gain", self.gain, "the largest of any region [1/s]");
    field("corrections", self.corrections, "steps that were corrected");
    field("weakened", self.weakened, "corrections halved until the blood's mesh could follow");
    field("largest_correction", self.largest_correction, "of a step, of a node of the lumen [length]");
    field("largest_correction_mm", self.largest_correction_mm, "the same [mm]");
  }
};

/// A file that a case names.
struct ReadFile {
  static constexpr const char* type_name = "read_file";
  std::string field, name, content;

  static void fields(auto& self, auto&& field) {
    field("field", self.field, "of the case");
    field("name", self.name, "as the case has it");
    field("content", self.content, "a hash of what it held when the run started");
  }
};

/// Of what a run is the result: whoever uses it again asks whether that is still the same.
struct MadeFrom {
  static constexpr const char* type_name = "made_from";
  std::string case_text;
  std::vector<ReadFile> files;
  bool coupled_otherwise = false;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_text, "the case as one file, YAML");
    field("files", self.files, "that it names");
    field("coupled_otherwise", self.coupled_otherwise, "some of its steps, before a continuation");
  }
};

/// summary.json: what was run, how it went and what it cost.
struct RunSummary {
  static constexpr const char* type_name = "run_summary";
  std::string case_name, title, case_file;
  UnitsUsed units;
  std::int64_t steps = 0;
  std::optional<std::int64_t> resumed_at_step;
  double dt = 0;
  TimeSpan time;
  double wall_seconds = 0, seconds_per_step = 0, cpu_seconds_per_step = 0;
  std::map<std::string, double> cpu_seconds, loop_cpu_seconds, peak_memory_mb;
  std::map<std::string, std::int64_t> unknowns;
  std::string coupling_method;
  MeanAndMax coupling_iterations, krylov_iterations;
  std::int64_t repeated_steps = 0;
  double mass_balance_error_max = 0;
  std::optional<InterfaceRecord> interface;
  std::optional<PressureRange> pressure;
  double max_displacement = 0, max_displacement_mm = 0;
  std::map<std::string, FollowedPoint> points;
  std::optional<RestState> rest;
  std::optional<Periodicity> periodicity;
  std::optional<ObserverWork> observer;
  std::map<std::string, std::string> written;
  std::vector<std::string> notices;
  std::map<std::string, std::string> versions;
  JsonTree effective_case;
  MadeFrom made_from;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_name, "its name");
    field("title", self.title, "of the case");
    field("case_file", self.case_file, "path");
    field("units", self.units, "of all figures that say no other");
    field("steps", self.steps, "of the whole run");
    field("resumed_at_step", self.resumed_at_step, "null: it was not");
    field("dt", self.dt, "step [s]");
    field("time", self.time, "simulated");
    field("wall_seconds", self.wall_seconds, "of the steps, in all parts of a run that was resumed");
    field("seconds_per_step", self.seconds_per_step, "wall clock");
    field("cpu_seconds_per_step", self.cpu_seconds_per_step, "of all processes");
    field("cpu_seconds", self.cpu_seconds, "of each process and their total, in all parts of a run that was resumed");
    field("loop_cpu_seconds", self.loop_cpu_seconds, "of the steps alone, those that wall_seconds counts");
    field("peak_memory_mb", self.peak_memory_mb, "[MB]");
    field("unknowns", self.unknowns, "of each code");
    field("coupling_method", self.coupling_method, "in words");
    field("coupling_iterations", self.coupling_iterations, "evaluations of both codes a step");
    field("krylov_iterations", self.krylov_iterations, "a step");
    field("repeated_steps", self.repeated_steps, "done in halves");
    field("mass_balance_error_max", self.mass_balance_error_max, "[flow]");
    field("interface", self.interface, "between fluid and wall; its errors since the run began or went on");
    field("pressure", self.pressure, "of the blood's observables; null: it has none");
    field("max_displacement", self.max_displacement, "of the lumen [length]");
    field("max_displacement_mm", self.max_displacement_mm, "the same [mm]");
    field("points", self.points, "followed ones, by name");
    field("rest", self.rest, "how the wall rests in the image; null: the wall's code does not say");
    field("periodicity", self.periodicity, "from beat to beat; null: there are not two, or no period");
    field("observer", self.observer, "null: none");
    field("written", self.written, "files of results, and a hash of what each held when the run ended");
    field("notices", self.notices, "of the programs");
    field("versions", self.versions, "of the programs");
    field("effective_case", self.effective_case, "the case with all defaults");
    field("made_from", self.made_from, "of what it is the result");
  }
};

}  // namespace tether
