#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vessel/mesh_file.hpp"

namespace tether {

/// VTK's numbers of the kinds of cells that can be read or passed over.
enum VtkCell : int {
  vtk_vertex = 1,
  vtk_poly_vertex = 2,
  vtk_line = 3,
  vtk_poly_line = 4,
  vtk_triangle = 5,
  vtk_triangle_strip = 6,
  vtk_polygon = 7,
  vtk_quad = 9,
  vtk_tetrahedron = 10,
  vtk_wedge = 13
};

/// "cell 3 (from 0) names point 17: the file has 12, numbered from 0", of the first node that is no point; else "".
std::string wrong_node(std::size_t cell, std::span<const std::int64_t> nodes, std::int64_t points);

/// Sorts the cells of a file into a mesh by their kind, and remembers which cell each triangle came from.
class CellSorter {
 public:
  explicit CellSorter(MeshFile& mesh) : mesh_(mesh) {}

  /// Nodes must be points of the mesh. Throws InputError: a kind that cannot be read, too few or too many nodes.
  void add(int type, std::span<const std::int64_t> nodes);

  std::size_t cells() const { return cells_; }
  /// Of each triangle, from 0.
  const std::vector<std::size_t>& triangle_cells() const { return triangle_cells_; }

 private:
  void check_size(int type, std::size_t nodes) const;
  void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c);

  MeshFile& mesh_;
  std::size_t cells_ = 0;
  std::vector<std::size_t> triangle_cells_;
};

/// A label as an integer: what is no such number (not a number, beyond 64 bits) is the smallest.
std::int64_t label_of(double value);

/// Makes an array of one value a cell the labels of the mesh's triangles. Throws InputError unless there are as many.
void add_labels(MeshFile& mesh, const std::string& name, std::span<const double> values, const CellSorter& cells);

/// Makes the array GlobalNodeID the ids of the mesh's nodes. Throws InputError unless there are as many.
void add_node_ids(MeshFile& mesh, std::span<const double> values);

}  // namespace tether
