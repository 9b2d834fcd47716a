#pragma once

#include <string>
#include <vector>

#include "fsi_master/results/run_summary.hpp"

namespace tether {

/// What a run that was compared with nothing came to, the most important first.
std::vector<std::string> sentences_of(const RunSummary& run);

}  // namespace tether
