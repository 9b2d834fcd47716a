#pragma once

#include "common/config/command_line.hpp"
#include "diagnosis/search/diagnosis.hpp"

namespace tether {

/// What the case lacks, by runs of the programs: diagnosis.json, suggested.yaml, corrected.yaml in `output`. command:
/// how many processes share the runs, whether progress is told. Throws InputError, RunError.
Diagnosis diagnosed(const DiagnosedCase& given, const CommandLine& command, const std::filesystem::path& output,
                    const DiagnosisSettings& settings);

/// The verb, told what came of earlier diagnoses. Returns the exit code.
int diagnose_further(const CommandLine& command, const DiagnosisSettings& settings);

}  // namespace tether
