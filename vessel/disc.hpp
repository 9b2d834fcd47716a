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
/// the rim. In each ring the nodes of even place come first, at the rim of a flipped one those of odd place: cutting
/// the prisms between discs, every other one flipped, by the smaller node index then lets diagonals meet crosswise at
/// every second node of the interface. That is symmetric, without a preferred sense of rotation, and the one pattern on
/// which walls of nearly incompressible prisms do not lock (docs/decisions/0020-wall-element.md).
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
  /// Node number in a flipped disc of each node.
  std::vector<int> flipped() const;
};

/// Throws InputError if `around` is odd or below 8, or the boundary layers leave no core.
Disc make_disc(const DiscSettings& settings);

}  // namespace tether
