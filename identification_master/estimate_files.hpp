#pragma once

#include <filesystem>

#include "common/io/growing_table.hpp"
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

/// estimate.csv: a row a step, the prior's before the first, with mean, interval and theta of each parameter, their
/// correlations, and how the data fit.
class EstimateTable {
 public:
  /// parameters: must outlive it.
  EstimateTable(const std::filesystem::path& output, const IdentifiedParameters& parameters);
  /// Anew, with the prior. Throws RunError as all that write.
  void start(const EstimateRecord& prior);
  /// Goes on behind that step; rows of later ones are dropped. Throws InputError as GrowingTable does.
  void resume(std::int64_t step, std::uint64_t checksum) { table_.resume(step + 1, checksum); }
  void append(const EstimateRecord& record);
  void flush() const { table_.flush(); }
  std::uint64_t checksum() const { return table_.checksum(); }

 private:
  const IdentifiedParameters& parameters_;
  GrowingTable table_;
};

/// estimate.json: prior and estimate, correlations, what the data can tell (K.7), whether innovations are consistent,
/// cost. docs/identification.md
void write_estimate(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                    const Identification& done, const IdentificationFacts& facts);

/// Takes away what an earlier run left in its folder, lest it be taken for what this one found.
void remove_old_estimates(const std::filesystem::path& output);

}  // namespace tether
