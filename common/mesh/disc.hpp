#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// How a lumen's cross-section is filled with triangles.
struct DiscSettings {
  int around = 24;          ///< nodes on the rim, even
  int boundary_layers = 2;  ///< thin rings next to the rim
  double boundary_layer_ratio =
      0.6;  ///< thickness of each of them over the one further in (the first: over the rim's spacing)
};

/// Nodes and triangles of the unit disc in polar coordinates, laid out in rings. Ring 0 is the centre, the last ring
/// the rim. In each ring the nodes of even place come first: cutting prisms by the smaller node index then gives a
/// zigzag that is symmetric about every radial plane, without a preferred sense of rotation.
struct Disc {
  struct Ring {
    int first, count;
    double radius;  ///< over the rim's
    int node(int place) const;
  };
  std::vector<Ring> rings;
  std::vector<Triangle> triangles;  ///< counterclockwise
  const Ring& rim() const { return rings.back(); }
  int node_count() const { return rim().first + rim().count; }
};

/// Throws InputError if `around` is odd or below 8, or the boundary layers leave no core.
Disc make_disc(const DiscSettings& settings);

}  // namespace tether
