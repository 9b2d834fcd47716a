#include "vessel/cell_sorter.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "common/base/error.hpp"

namespace tether {

std::string wrong_node(std::size_t cell, std::span<const std::int64_t> nodes, std::int64_t points) {
  const auto wrong = std::find_if(nodes.begin(), nodes.end(), [&](auto node) { return node < 0 || node >= points; });
  if (wrong == nodes.end()) return "";
  return fmt::format("cell {} (from 0) names point {}: the file has {}, numbered from 0", cell, *wrong, points);
}

void CellSorter::check_size(int type, std::size_t nodes) const {
  struct Sizes {
    std::size_t least, most;
  };
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  static const std::map<int, Sizes> allowed{{vtk_vertex, {1, 1}},
                                            {vtk_poly_vertex, {1, any}},
                                            {vtk_line, {2, 2}},
                                            {vtk_poly_line, {1, any}},
                                            {vtk_triangle, {3, 3}},
                                            {vtk_polygon, {3, any}},
                                            {vtk_triangle_strip, {3, any}},
                                            {vtk_quad, {4, 4}},
                                            {vtk_tetrahedron, {4, 4}},
                                            {vtk_wedge, {6, 6}}};
  const auto found = allowed.find(type);
  if (found == allowed.end())
    throw input_error("{}: cell {} is of VTK type {}: only linear tetrahedra, wedges and surface cells can be read",
                      mesh_.name, cells_, type);
  if (nodes < found->second.least || nodes > found->second.most)
    throw input_error("{}: cell {} (from 0), of VTK type {}, has {} nodes", mesh_.name, cells_, type, nodes);
}

void CellSorter::add_triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
  mesh_.triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  triangle_cells_.push_back(cells_);
}

void CellSorter::add(int type, std::span<const std::int64_t> nodes) {
  check_size(type, nodes.size());
  const auto node = [&](std::size_t i) { return static_cast<int>(nodes[i]); };
  if (type == vtk_tetrahedron) {
    mesh_.tetrahedra.push_back({node(0), node(1), node(2), node(3)});
  } else if (type == vtk_wedge) {
    mesh_.prisms.push_back({node(0), node(2), node(1), node(3), node(5), node(4)});
  } else if (type == vtk_triangle || type == vtk_quad || type == vtk_polygon) {
    for (std::size_t i = 2; i < nodes.size(); ++i) add_triangle(nodes[0], nodes[i - 1], nodes[i]);
  } else if (type == vtk_triangle_strip) {  // every second triangle of a strip looks the other way
    for (std::size_t i = 2; i < nodes.size(); ++i)
      i % 2 == 0 ? add_triangle(nodes[i - 2], nodes[i - 1], nodes[i])
                 : add_triangle(nodes[i - 1], nodes[i - 2], nodes[i]);
  }
  ++cells_;
}

std::int64_t label_of(double value) {
  constexpr double limit = 0x1p63;
  return value >= -limit && value < limit ? static_cast<std::int64_t>(value) : std::numeric_limits<std::int64_t>::min();
}

void add_labels(MeshFile& mesh, const std::string& name, std::span<const double> values, const CellSorter& cells) {
  if (values.size() != cells.cells())
    throw input_error("{}: array {} has {} values: the file has {} cells", mesh.name, name, values.size(),
                      cells.cells());
  std::vector<std::int64_t> labels;
  for (const std::size_t cell : cells.triangle_cells()) labels.push_back(label_of(values[cell]));
  mesh.triangle_labels[name] = std::move(labels);
}

void add_node_ids(MeshFile& mesh, std::span<const double> values) {
  if (static_cast<Eigen::Index>(values.size()) != mesh.points.cols())
    throw input_error("{}: array GlobalNodeID has {} values: the file has {} points", mesh.name, values.size(),
                      mesh.points.cols());
  mesh.node_ids.clear();
  for (const double value : values) mesh.node_ids.push_back(label_of(value));
}

}  // namespace tether
