#pragma once

#include "diagnosis/trace_discrepancy.hpp"
#include "diagnosis/velocity_discrepancy.hpp"
#include "diagnosis/verdict.hpp"

namespace tether {

/// The run that was compared.
struct ComparedRun {
  std::string case_name, title, folder;
  int steps = 0;
  double start = 0, end = 0;  ///< [time]
  double observer_gain = 0;   ///< above zero the run was pulled toward the data, and is no evidence [1/time]
  bool is_evidence() const { return observer_gain == 0; }
};

/// A run set against all that was measured.
struct Comparison {
  ComparedRun run;
  UnitSystem units = UnitSystem::cgs();
  std::vector<SourceDiscrepancy> sources;
  std::vector<TraceDiscrepancy> traces;
  std::vector<VelocityDiscrepancy> velocities;
};

/// What is compared of a run.
struct RunResults {
  RunMotion motion;
  std::function<RunTrace(const Trace&)> trace;  ///< the column of its table that it is compared with
  RunVelocity velocity;
};

/// Compares everything.
Comparison compare(const Observations& data, const std::vector<std::string>& region_names, const RunResults& run);

/// What a person should know first, one sentence each: that the run is no evidence, where and when it fails.
std::vector<std::string> sentences_of(const Comparison& comparison);

/// comparison.json, comparison.csv and comparison_blood.csv (docs/comparison.md), in the case's units. Throw RunError
/// if they cannot be written.
void write_json(const std::filesystem::path& path, const Comparison& comparison);
void write_csv(const std::filesystem::path& path, const Comparison& comparison);
/// Traces and velocities.
void write_blood_csv(const std::filesystem::path& path, const Comparison& comparison);

}  // namespace tether
