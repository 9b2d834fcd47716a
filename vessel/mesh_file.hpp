#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What a mesh file holds: a volume mesh, a surface, or both.
struct MeshFile {
  std::string name;  ///< the path, for errors
  Points points;
  std::vector<Tetrahedron> tetrahedra;  ///< in the file's order of nodes
  std::vector<Prism> prisms;            ///< bottom looking toward the top, whichever way the file has it
  std::vector<Triangle> triangles;
  std::vector<std::int64_t> node_ids;  ///< "GlobalNodeID" of a VTK file, else empty

  /// Integer labels by name of the array: one value a triangle. Gmsh: array "physical".
  std::map<std::string, std::vector<std::int64_t>> triangle_labels;
  std::map<std::string, std::int64_t> group_names;  ///< of Gmsh's physical surfaces
};

/// Reads .vtu, .vtp, .vtk (unstructured grids and surfaces), .ply (surfaces; polygons of more than three sides become
/// fans), .msh (Gmsh 2 and 4, text and binary), .stl (text and binary; equal vertices merged) and .obj. Throws
/// InputError: cannot be read, other cells than these, no points.
MeshFile read_mesh_file(const std::filesystem::path& path);

}  // namespace tether
