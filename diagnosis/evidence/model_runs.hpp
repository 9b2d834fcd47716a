#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/protocol/messages.hpp"
#include "identification_master/results/named_values.hpp"
#include "observation_manager/measurements/measured_run.hpp"

namespace tether {

/// A run of the model with some numbers at other values than it has.
struct WantedRun {
  std::string folder;  ///< where its files are, below the diagnosis' folder; it tells people what the run is
  NamedValues values;
};

/// What runs took.
struct RunsCost {
  int runs = 0, made = 0;        ///< all, and those that were not there yet
  std::int64_t evaluations = 0;  ///< of fluid and solid together, of those made
  double cpu_seconds = 0;        ///< of those made
};

/// Whole runs of one model, as the diagnosis asks for them; what makes them is none of its business.
class ModelRuns {
 public:
  virtual ~ModelRuns() = default;
  /// The model's numbers that can be set.
  virtual const std::vector<protocol::ParameterInfo>& parameters() const = 0;
  /// What every run records over time, such as "fluid.outlet.pressure".
  virtual std::vector<std::string> columns() const = 0;
  /// One for each that is wanted, in their order; a run that does not come to its end says why. Throws InputError if
  /// the model is refused, RunError if no more runs can be made.
  virtual std::vector<FinishedMotion> make(const std::vector<WantedRun>& wanted) = 0;
  virtual RunsCost cost() const = 0;
};

}  // namespace tether
