#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/search/diagnosis_report.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"

namespace tether {

/// The lumen with how significant what is left is about each place, and the patch where it is largest: misfit.vtu,
/// misfit_patch.vtp, plots/misfit.png. Returns the picture's name; none where it cannot be drawn, or no data lie on the
/// lumen.
std::vector<std::string> draw_misfit(const LumenSurface& lumen, const DiagnosisReport& report,
                                     const std::filesystem::path& output);

}  // namespace tether
