#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/mesh/locator.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/vessel_files.hpp"

namespace tether {

/// The boundary of a volume mesh, on which faces from elsewhere are found: their triangles come back with the volume's
/// nodes, outward, a prism's sides cut as split_into_tetrahedra cuts them.
class FaceFinder {
 public:
  /// volume and label_array must outlive the finder.
  FaceFinder(const MeshFile& volume, const std::string& label_array);

  /// Throws InputError: a node that the volume does not have, a triangle not on its boundary, a label that does not
  /// exist.
  std::vector<Triangle> find(const FaceSource& source, double scale) const;

 private:
  std::vector<Triangle> found(const FaceSource& source, double scale) const;
  std::vector<int> matched_nodes(const MeshFile& surface) const;
  std::vector<Triangle> on_boundary(const std::vector<Triangle>& triangles, const std::string& from) const;
  std::vector<Triangle> labelled(const MeshFile& mesh, const FaceSource& source) const;

  const MeshFile& volume_;
  const std::string& label_array_;
  PointLocator locator_;
  double tolerance_;
  std::map<std::int64_t, int> node_of_id_;
  /// By three nodes, ascending: the boundary triangles they stand for (two for three nodes of a prism's side).
  std::map<Triangle, std::vector<Triangle>> boundary_;
};

}  // namespace tether
