#pragma once

#include "diagnosis/diagnosis_report.hpp"
#include "tether/candidates.hpp"

namespace tether {

/// The case with the effects that were accepted, at the amplitudes found, and a section `identification` that finds
/// them anew, all together. Returns false, and writes nothing, if no effect of the model was accepted.
bool write_suggested(const std::filesystem::path& file, const CaseFile& from, const DiagnosisReport& report,
                     const std::vector<PlacedEffect>& effects);

}  // namespace tether
