#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenarios/case_variant.hpp"

namespace tether {

/// A run's table.
struct RunTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

inline RunTable table_of(const std::filesystem::path& run) {
  std::ifstream file(run / "timeseries.csv");
  RunTable table;
  for (std::string line, cell; std::getline(file, line);) {
    std::istringstream cells(line);
    if (table.columns.empty()) {
      while (std::getline(cells, cell, ',')) table.columns.push_back(cell);
      continue;
    }
    std::vector<double>& row = table.rows.emplace_back();
    while (std::getline(cells, cell, ',')) row.push_back(std::stod(cell));
  }
  return table;
}

/// The name of a component's vector ("x.force_y [N]" is one of "x.force_ [N]"), or of what has no components.
inline std::string vector_of(std::string column) {
  for (const char* component : {"_x [", "_y [", "_z ["})
    if (const auto place = column.find(component); place != std::string::npos) return column.erase(place + 1, 1);
  return column;
}

/// Of all steps, each number to `tolerance` of the largest of its column, and of the other components of its vector.
/// `without`: columns whose names begin so are not compared; empty: all are.
inline void expect_same_table(const std::filesystem::path& one, const std::filesystem::path& other, std::size_t steps,
                              double tolerance, const std::string& without = {}) {
  const RunTable expected = table_of(one), found = table_of(other);
  ASSERT_EQ(expected.rows.size(), steps);
  ASSERT_EQ(found.rows.size(), steps);
  ASSERT_EQ(found.columns, expected.columns);
  std::map<std::string, double> largest;
  for (std::size_t c = 0; c < expected.columns.size(); ++c)
    for (const auto& row : expected.rows) {
      double& so_far = largest[vector_of(expected.columns[c])];
      so_far = std::max(so_far, std::abs(row.at(c)));
    }
  for (std::size_t c = 0; c < expected.columns.size(); ++c) {
    const std::string& name = expected.columns[c];
    if (!without.empty() && name.starts_with(without)) continue;
    for (std::size_t step = 0; step < steps; ++step)
      EXPECT_NEAR(found.rows[step].at(c), expected.rows[step][c], tolerance * std::max(largest[vector_of(name)], 1e-3))
          << name << " of row " << step;
  }
}

}  // namespace tether
