#pragma once

#include "common/config/overlay.hpp"
#include "diagnosis/search/diagnosis_report.hpp"
#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// What the case must say so that the errors of the data that a diagnosis accepted are taken off them: on top of what
/// it says of them already. Frames that are wrong alone are left out; nothing for what its fault cannot take off.
std::vector<Overlay::Value> corrections_of(const DiagnosisReport& report, const ObservationsCase& observations);

}  // namespace tether
