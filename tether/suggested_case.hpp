#pragma once

#include "diagnosis/diagnosis_report.hpp"
#include "tether/candidates.hpp"
#include "tether/diagnosed_case.hpp"

namespace tether {

/// The case with the effects that were accepted, at the amplitudes found, a section `identification` that finds them
/// anew, all together, and the data corrected of the errors that were accepted. Returns false, and writes nothing, if
/// there is nothing to add or correct.
bool write_suggested(const std::filesystem::path& file, const DiagnosedCase& given, const DiagnosisReport& report,
                     const std::vector<PlacedEffect>& effects);

}  // namespace tether
