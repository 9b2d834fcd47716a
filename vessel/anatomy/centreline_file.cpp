#include "vessel/anatomy/centreline_file.hpp"

#include <algorithm>
#include <fstream>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {

namespace {

int index_of(const CentrelineTree& tree, const std::string& name) {
  for (std::size_t i = 0; i < tree.branches.size(); ++i)
    if (tree.branches[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

CentrelineTree read_centreline(const std::filesystem::path& file, const UnitSystem& units) {
  const CsvTable table(file);
  const std::vector<std::string> names = table.names("branch");
  const std::vector<std::string> parents =
      table.has("parent") ? table.names("parent") : std::vector<std::string>(table.rows());
  const auto lengths = [&](const char* column) { return table.quantities(column, units, dimension::length); };
  const std::vector<double> x = lengths("x"), y = lengths("y"), z = lengths("z"), radius = lengths("radius");
  CentrelineTree tree;
  std::vector<std::size_t> first_rows;  // of the branches
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!(radius[row] > 0)) throw input_error("{}: radius: {:g}: must be positive", table.where(row), radius[row]);
    if (tree.branches.empty() || tree.branches.back().name != names[row]) {
      if (index_of(tree, names[row]) >= 0)
        throw input_error("{}: branch {} occurs in two places: its rows must stand together", table.where(row),
                          names[row]);
      Branch branch{names[row], tree.branches.empty() ? -1 : 0, {}, {}};
      if (!parents[row].empty() && (branch.parent = index_of(tree, parents[row])) < 0)
        throw input_error("{}: branch {} leaves {}, which does not stand before it", table.where(row), names[row],
                          parents[row]);
      tree.branches.push_back(std::move(branch));
      first_rows.push_back(row);
    }
    tree.branches.back().points.emplace_back(x[row], y[row], z[row]);
    tree.branches.back().radii.push_back(radius[row]);
  }
  for (std::size_t i = 0; i < first_rows.size(); ++i) {
    const std::vector<Vec3>& points = tree.branches[i].points;
    if (std::all_of(points.begin(), points.end(), [&](const Vec3& point) { return point == points.front(); }))
      throw input_error("{}: branch {}: has no length: must have at least two points apart", table.where(first_rows[i]),
                        tree.branches[i].name);
  }
  return tree;
}

void write_centreline(const std::filesystem::path& file, const CentrelineTree& tree, const std::string& unit) {
  std::ofstream out(file);
  out << fmt::format("branch, parent, x [{0}], y [{0}], z [{0}], radius [{0}]\n", unit);
  for (const Branch& branch : tree.branches)
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const Vec3& x = branch.points[i];
      const std::string parent = branch.parent < 0 ? "" : tree.branches[static_cast<std::size_t>(branch.parent)].name;
      out << fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g}\n", branch.name, parent, x[0], x[1], x[2], branch.radii[i]);
    }
  if (!out.flush()) throw write_error(file);
}

}  // namespace tether
