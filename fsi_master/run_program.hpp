#pragma once

#include <string>
#include <vector>

namespace tether {

struct ProgramEnd {
  int exit_code = 0;
  std::string errors;  ///< what it wrote to stderr
};

/// Runs a program to its end. Throws RunError if it cannot be started or is killed.
ProgramEnd run_program(const std::string& executable, const std::vector<std::string>& arguments);

}  // namespace tether
