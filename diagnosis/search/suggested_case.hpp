#pragma once

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/search/diagnosis_report.hpp"

namespace tether {

/// The case with its data corrected of the errors that were accepted. Returns false, and writes nothing, if there are
/// none that a case can take off.
bool write_corrected(const std::filesystem::path& file, const DiagnosedCase& given, const DiagnosisReport& report);

/// The same with the effects that were accepted too, at the amplitudes found, and a section `identification` that finds
/// them anew, all together. Returns false, and writes nothing, if no effect of the model was accepted.
bool write_suggested(const std::filesystem::path& file, const DiagnosedCase& given, const DiagnosisReport& report);

}  // namespace tether
