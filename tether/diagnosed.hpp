#pragma once

#include "common/config/command_line.hpp"
#include "diagnosis/search/diagnosis.hpp"
#include "tether/verbs.hpp"

namespace tether {

/// Throws InputError if the programs, which it starts, refuse the case, or know no number that its diagnosis names.
void check_numbers(const DiagnosedCase& given, const CommandLine& command);

/// The verb, told what came of earlier diagnoses.
Made<Diagnosis> diagnose_further(const CommandLine& command, const DiagnosisSettings& settings);

}  // namespace tether
