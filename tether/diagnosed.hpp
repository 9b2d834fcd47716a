#pragma once

#include "common/config/command_line.hpp"
#include "diagnosis/search/diagnosis.hpp"
#include "tether/verbs.hpp"

namespace tether {

/// The verb, told what came of earlier diagnoses.
Made<Diagnosis> diagnose_further(const CommandLine& command, const DiagnosisSettings& settings);

}  // namespace tether
