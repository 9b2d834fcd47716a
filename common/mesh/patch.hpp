#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A triangle that is part of a mesh's triangle: its corners in the other's barycentric coordinates, one a column.
struct TrianglePart {
  Triangle of;
  Mat3 corners = Mat3::Identity();

  /// Of the other triangle's area.
  double share() const { return std::abs(corners.determinant()); }
};

/// A named piece of a boundary. Triangles index the volume mesh's nodes and are oriented OUT of that volume.
struct Patch {
  std::string name;
  std::vector<Triangle> triangles;       ///< where the border cuts triangles, those of which it has more than others
  std::vector<TrianglePart> parts = {};  ///< all of it, where its border cuts triangles; else none
};

/// All of a patch, exactly.
std::vector<TrianglePart> parts_of(const Patch& patch);

/// [length^2]
double area_of(const Points& points, const Patch& patch);

}  // namespace tether
