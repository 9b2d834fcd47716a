#include "vessel/contours.hpp"

#include <set>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"

namespace tether {

std::vector<Points> read_contours(const std::filesystem::path& file) {
  const CsvTable table(file);
  const std::vector<std::string> section = table.names("section");
  const std::vector<double> x = table.numbers("x"), y = table.numbers("y"), z = table.numbers("z");
  std::vector<Points> contours;
  std::set<std::string> seen;
  for (std::size_t row = 0, end = 0; row < table.rows(); row = end) {
    if (!seen.insert(section[row]).second)
      throw input_error("{}: section {} occurs in two places: its rows must stand together", table.where(row),
                        section[row]);
    while (end < table.rows() && section[end] == section[row]) ++end;
    if (end - row < 8)
      throw input_error("{}: section {} has {} points: at least 8 are needed", table.where(row), section[row],
                        end - row);
    Points points(3, static_cast<Eigen::Index>(end - row));
    for (std::size_t i = row; i < end; ++i) points.col(static_cast<Eigen::Index>(i - row)) << x[i], y[i], z[i];
    contours.push_back(std::move(points));
  }
  return contours;
}

}  // namespace tether
