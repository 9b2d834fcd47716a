#pragma once

#include <cmath>
#include <cstdio>
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

}  // namespace tether
