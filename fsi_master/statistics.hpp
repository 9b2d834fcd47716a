#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tether {

/// Mean and largest of a number that comes once a step.
struct MeanMax {
  double sum = 0, max = 0, count = 0;
  void add(double value) {
    sum += value;
    max = std::max(max, value);
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0.0; }
};

/// Smallest and largest seen.
struct MinMax {
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();
  bool empty() const { return min > max; }
  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

/// What a process cost over all parts of a run: the first, and those after a resume.
struct ProcessTotals {
  double cpu_seconds = 0;       ///< with starting up in each part
  double loop_cpu_seconds = 0;  ///< of the steps that count in the run's wall clock
  double peak_memory_mb = 0;    ///< in any part
};

/// What the summary tells of all steps, those before a resume included.
struct RunStatistics {
  MeanMax evaluations, krylov_iterations;
  MinMax pressure;              ///< of the fluid's observables
  double max_displacement = 0;  ///< of the interface
  double mass_balance_error = 0;
  double repeated_steps = 0;  ///< done in halves
  double wall_seconds = 0;
  std::array<ProcessTotals, 4> processes;  ///< fsi_master, fluid, solid, observation_manager

  /// All numbers in order, for a checkpoint; the visitor may read or write them.
  template <class Visitor>
  void numbers(Visitor visit) {
    for (MeanMax* m : {&evaluations, &krylov_iterations}) visit(m->sum), visit(m->max), visit(m->count);
    visit(pressure.min), visit(pressure.max), visit(max_displacement), visit(mass_balance_error), visit(repeated_steps);
    visit(wall_seconds);
    for (ProcessTotals& p : processes) visit(p.cpu_seconds), visit(p.loop_cpu_seconds), visit(p.peak_memory_mb);
  }
};

}  // namespace tether
