#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"

/// Files for viewing in ParaView. Written without VTK: raw appended binary, as fast as the disk.
namespace tether {

/// Named values at nodes or cells: scalars (1), vectors (3: x y z) or tensors (9: by rows) one after the other.
struct Field {
  std::string name;
  int components;
  std::vector<double> values;

  static Field scalars(std::string name, const VectorXd& one_each);
  static Field vectors(std::string name, const Points& columns);
  /// node_wise: three values a node, nodes one after the other.
  static Field vectors(std::string name, std::span<const double> node_wise);
};

/// The cells of a file, written in this order. Prisms become VTK_WEDGE, whose base looks away from its top: nodes 0 2 1
/// 3 5 4 of ours.
struct Cells {
  std::span<const Tetrahedron> tetrahedra{};
  std::span<const Prism> prisms{};
  std::span<const Triangle> triangles{};
  std::size_t count() const { return tetrahedra.size() + prisms.size() + triangles.size(); }
};
inline Cells cells_of(const FluidMesh& fluid) {
  return {.tetrahedra = fluid.tetrahedra};
}
inline Cells cells_of(const WallMesh& wall) {
  return {.tetrahedra = wall.tetrahedra, .prisms = wall.prisms};
}

/// Throws RunError if the file cannot be written; the number of values of each field must be that of nodes or cells.
void write_vtu(const std::filesystem::path& path, const Points& points, const Cells& cells,
               const std::vector<Field>& at_nodes, const std::vector<Field>& in_cells = {});

}  // namespace tether
