#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "twin/twin_case.hpp"

namespace tether {

/// What was hidden in data, and how they were made.
struct Answer {
  struct Effect {
    std::string name, where, unit;  ///< an empty place: any
    double amplitude = 0;
  };
  std::string verdict;
  std::vector<Effect> effects;
  std::string truth;  ///< the case file of the run
  int seed = 0;
  double noise = 0, image_error = 0;  ///< standard deviations of what was added, and of the image [length]
};

Answer answer_of(const TwinCase& given);

/// Where a twin's folder keeps its answer.
std::filesystem::path sealed_answer(const std::filesystem::path& folder);

/// Written such that nobody reads it by accident (JSON in base 64). Throws RunError if it cannot be written.
void seal(const std::filesystem::path& file, const Answer& answer);
/// Throws InputError if the file is no sealed answer.
Answer unsealed(const std::filesystem::path& file);

}  // namespace tether
