#pragma once

#include <filesystem>
#include <string>

namespace tether {

bool has_gnuplot();

/// What every script of ours begins with: a picture of so many pixels, a grid.
std::string gnuplot_head(int width, int height);

/// A text as gnuplot takes it literally, whatever it holds: in single quotes, its own doubled, control characters as
/// spaces.
std::string gnuplot_text(const std::string& text);

/// The same as a cell of a data block, which is one line.
std::string gnuplot_cell(const std::string& text);

/// Keeps the script as OUTPUT/plots/NAME and runs it in OUTPUT. Throws RunError if gnuplot fails.
void run_gnuplot(const std::filesystem::path& output, const std::string& name, const std::string& script);

}  // namespace tether
