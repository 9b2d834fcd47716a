#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "common/base/child_process.hpp"

namespace tether {

/// Every file of results below the folder is as its schema says.
inline void expect_valid_results(const std::filesystem::path& folder) {
  const ChildEnd end = capture({{"/usr/bin/python3", "-m", "tether.validate", folder.string()},
                                {{"PYTHONPATH", TETHER_SOURCE "/tools/python"}, {"PYTHONDONTWRITEBYTECODE", "1"}}});
  EXPECT_EQ(end.exit_code, 0) << end.output << end.errors;
}

/// What a Python script prints that uses the package `tether`.
inline std::string said_by_python(const std::string& script) {
  const ChildEnd end = capture({{"/usr/bin/python3", "-c", script},
                                {{"PYTHONPATH", TETHER_SOURCE "/tools/python"}, {"PYTHONDONTWRITEBYTECODE", "1"}}});
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  return end.output;
}

}  // namespace tether
