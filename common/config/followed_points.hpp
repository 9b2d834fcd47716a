#pragma once

#include "common/base/types.hpp"
#include "common/config/case_file.hpp"

namespace tether {

/// Throws InputError for one of output.points that is farther from all nodes of the lumen than a tenth of the vessel's
/// diagonal: it is none of this vessel's.
void check_followed(const CaseFile& file, const Points& lumen);

}  // namespace tether
