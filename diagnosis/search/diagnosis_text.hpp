#pragma once

#include <filesystem>

#include "diagnosis/results/diagnosis.hpp"

namespace tether {

/// What tether diagnose prints: sentences, then the strongest candidates, one a line.
std::string text_of(const Diagnosis& diagnosis);

/// Draws the ranking as OUTPUT/plots/diagnosis.png. Returns the picture's name; nothing without gnuplot.
std::vector<std::string> draw_ranking(const Diagnosis& diagnosis, const std::filesystem::path& output);

}  // namespace tether
