#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace tether {

/// One line of output for docs/verification.md and its plots: errors at so many nodes around (or steps), and the
/// orders between them.
inline void report(const std::string& what, std::span<const int> resolutions, std::span<const double> errors) {
  std::printf("| %s |", what.c_str());
  for (const int n : resolutions) std::printf(" %d", n);
  std::printf(" |");
  for (const double error : errors) std::printf(" %.3g", error);
  std::printf(" |");
  for (std::size_t i = 1; i < errors.size(); ++i)
    std::printf(" %.2f", std::log(errors[i - 1] / errors[i]) / std::log(double(resolutions[i]) / resolutions[i - 1]));
  std::printf(" |\n");
}

inline void report(const std::string& what, double value) {
  std::printf("| %s | %.2g |\n", what.c_str(), value);
}

/// Two columns into the folder named by the environment's TETHER_SERIES, for tools/verification-plots; otherwise
/// nothing.
inline void write_series(const std::string& name, std::span<const double> x, std::span<const double> y) {
  const char* folder = std::getenv("TETHER_SERIES");
  if (folder == nullptr) return;
  std::ofstream file(std::filesystem::path(folder) / (name + ".txt"));
  for (std::size_t i = 0; i < x.size(); ++i) file << x[i] << " " << y[i] << "\n";
}

}  // namespace tether
