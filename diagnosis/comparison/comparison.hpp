#pragma once

#include "diagnosis/comparison/other_discrepancy.hpp"
#include "diagnosis/comparison/trace_discrepancy.hpp"
#include "diagnosis/comparison/velocity_discrepancy.hpp"
#include "diagnosis/comparison/verdict.hpp"

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
  std::vector<OtherDiscrepancy> others;  ///< of kinds without a form of their own
};

/// What is compared of a run.
struct RunResults {
  RunMotion motion;
  std::function<RunTrace(const Trace&)> trace;  ///< the column of its table that it is compared with
  RunVelocity velocity;
  FinishedMotion whole = {};  ///< for what has no form of its own
};

/// Compares everything. What has the form of distances, of values over time or of velocities is told as such.
Comparison compare(const Observations& data, const ErrorRegions& regions, const RunResults& run,
                   const UnitSystem& units = UnitSystem::cgs());

/// What a person should know first, one sentence each: that the run is no evidence, where and when it fails.
std::vector<std::string> sentences_of(const Comparison& comparison);

/// Of these, what is to be looked at before any physics, then where and when the model fails worst.
std::vector<std::string> first_look_of(const Comparison& comparison);

/// comparison.csv and comparison_blood.csv (docs/comparison.md), in the case's units. Throw RunError if they cannot be
/// written.
void write_csv(const std::filesystem::path& path, const Comparison& comparison);
/// Traces, velocities and kinds without a form of their own.
void write_blood_csv(const std::filesystem::path& path, const Comparison& comparison);

}  // namespace tether
