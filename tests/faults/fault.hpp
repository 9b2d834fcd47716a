#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// The environment of a program in which a fault of faults.c happens to the files of a folder. TETHER_FAULTS, the
/// library, is a definition of the test.
inline std::vector<std::pair<std::string, std::string>> with_fault(const std::string& fault,
                                                                   const std::filesystem::path& in) {
  const char* before = std::getenv("LD_PRELOAD");  // a sanitizer's tests have one
  return {{"LD_PRELOAD", before == nullptr ? TETHER_FAULTS : std::string(before) + ":" + TETHER_FAULTS},
          {"TETHER_FAULT_ROOT", in.string()},
          {"TETHER_FAULT", fault}};
}

}  // namespace tether
