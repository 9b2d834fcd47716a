#pragma once

#include "diagnosis/diagnosis_report.hpp"

namespace tether {

/// What tether diagnose prints: sentences, then the strongest candidates, one a line.
std::string text_of(const DiagnosisReport& report);

/// Draws the ranking as OUTPUT/plots/diagnosis.png. Returns the picture's name; nothing without gnuplot.
std::vector<std::string> draw_ranking(const DiagnosisReport& report, const std::filesystem::path& output);

}  // namespace tether
