#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "batch/job_status.hpp"

namespace tether {

/// One line for each case: its state, and of one that is done what its verb found, under headings with units.
struct JobResults {
  std::vector<std::string> columns;             ///< of all cases, in the order in which they come
  std::vector<std::vector<std::string>> cells;  ///< per case; empty where a case does not say

  std::string csv() const;   ///< RFC 4180
  std::string text() const;  ///< for a person, in columns
};

/// From the records that the cases left in the job's folder; what one that is not done left is not this job's. Why
/// one cannot be read stands in its own line.
JobResults results_of(const Job& job, const std::filesystem::path& folder, const std::vector<CaseStatus>& states);

}  // namespace tether
