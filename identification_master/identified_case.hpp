#pragma once

#include <filesystem>

#include "identification_master/identified_parameters.hpp"

namespace tether {

/// Writes a case that builds on the one identified, with the values of theta [p] in it: ready to simulate.
void write_identified_case(const std::filesystem::path& path, const CaseFile& from,
                           const IdentifiedParameters& parameters, const VectorXd& theta);

}  // namespace tether
