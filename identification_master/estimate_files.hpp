#pragma once

#include <filesystem>

#include "identification_master/checkpoint.hpp"

namespace tether {

/// What an identification has cost, and what it was.
struct IdentificationFacts {
  std::string case_name, title, case_file;
  std::size_t groups = 0;
  IdentificationCost cost;
  double peak_memory_mb = 0;
  std::vector<std::string> notices;
};

/// Median, as the model is told it, and 95 % interval, cut at the bounds, of a value whose theta is normally
/// distributed.
struct ValueEstimate {
  double median = 0, lower = 0, upper = 0;
};
ValueEstimate estimate_of(const IdentifiedParameter& parameter, double mean, double deviation);

/// estimate.csv: a row a step, with mean, interval and theta of each parameter, their correlations, and how the data
/// fit. All rows are written at once; throws RunError if that fails.
void write_estimates(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                     const std::vector<EstimateRecord>& records);

/// estimate.json: prior and estimate, correlations, what the data can tell (K.7), whether innovations are consistent,
/// cost. docs/identification.md
void write_estimate(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                    const Identification& done, const IdentificationFacts& facts);

/// Takes away what an earlier run left in its folder, lest it be taken for what this one found.
void remove_old_estimates(const std::filesystem::path& output);

}  // namespace tether
