#pragma once

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/search/further_measurement.hpp"

namespace tether {

/// What could be measured besides what the case has, from whole runs: pressures and flows at openings, twice the
/// frames, half the noise, the whole lumen, displacements of the wall itself. base_and_others: the base first.
std::vector<FurtherMeasurement> further_measurements(const DiagnosedCase& given, const Evidence& evidence,
                                                     const std::vector<FinishedMotion>& base_and_others,
                                                     const std::vector<std::string>& columns);

}  // namespace tether
