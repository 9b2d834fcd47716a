#pragma once

#include "common/config/case_file.hpp"

namespace tether {

/// How many cores a run of the case keeps busy: fluid and wall take turns, each in its own number of processes
/// (coupling.ranks).
int cores_of_model(const CaseFile& file);

}  // namespace tether
