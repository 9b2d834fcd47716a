#pragma once

#include <filesystem>
#include <string>

namespace tether {

bool has_gnuplot();

/// What every script of ours begins with: a picture of so many pixels, a grid.
std::string gnuplot_head(int width, int height);

/// Keeps the script as OUTPUT/plots/NAME and runs it in OUTPUT. Throws RunError if gnuplot fails.
void run_gnuplot(const std::filesystem::path& output, const std::string& name, const std::string& script);

}  // namespace tether
