#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Places on the triangles of a surface.
struct SurfacePlaces {
  Points points;              ///< [length]
  std::vector<int> triangle;  ///< each lies on
  Points barycentric;         ///< there
};

/// The nodes that the triangles use: column i is node i; others stay zero and are in no triangle (-1).
SurfacePlaces nodes_as_places(const Points& points, const std::vector<Triangle>& triangles);

/// Triangles cut into equal ones.
struct RefinedTriangles {
  SurfacePlaces places;
  std::vector<Triangle> parts;  ///< of places; so many in a row for each triangle
  int parts_each = 0;
};
/// chosen: the triangles to cut, each side into `pieces`.
RefinedTriangles refined(const Points& points, const std::vector<Triangle>& triangles, const std::vector<int>& chosen,
                         int pieces);

}  // namespace tether
