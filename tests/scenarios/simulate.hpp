#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tether {

/// The words of `tether simulate`, up to a step.
inline std::vector<std::string> simulate_line(const std::filesystem::path& case_file,
                                              const std::filesystem::path& output, int until,
                                              const std::vector<std::string>& more) {
  std::vector<std::string> words{TETHER_PROGRAM,  "simulate", case_file.string(),   "--output",
                                 output.string(), "--steps",  std::to_string(until)};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace tether
