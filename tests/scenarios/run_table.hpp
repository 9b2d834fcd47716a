#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenarios/case_variant.hpp"

namespace tether {

/// The numbers of a run's table, row by row.
inline std::vector<std::vector<double>> table_of(const std::filesystem::path& run) {
  std::ifstream file(run / "timeseries.csv");
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line.front())) == 0) continue;
    std::istringstream cells(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

/// Of all steps, each number to `tolerance` of the largest of its column.
inline void expect_same_table(const std::filesystem::path& one, const std::filesystem::path& other, std::size_t steps,
                              double tolerance) {
  const auto expected = table_of(one), found = table_of(other);
  ASSERT_EQ(expected.size(), steps);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t column = 0; column < expected.front().size(); ++column) {
    double largest = 0;
    for (const auto& row : expected) largest = std::max(largest, std::abs(row[column]));
    for (std::size_t row = 0; row < expected.size(); ++row)
      EXPECT_NEAR(found[row].at(column), expected[row][column], tolerance * std::max(largest, 1e-3))
          << row << ", " << column;
  }
}

}  // namespace tether
