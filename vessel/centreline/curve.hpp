#pragma once

#include <vector>

#include "common/base/types.hpp"

/// Polylines.
namespace tether {

using Polyline = std::vector<Vec3>;

/// Arc length at each point [cm].
std::vector<double> arc_lengths(const Polyline& line);

/// At equal distances of about `spacing`, both ends kept.
Polyline resampled(const Polyline& line, double spacing);

/// A Gaussian mean of width `width` [cm] along the line; ends stay, the width falls toward them.
Polyline smoothed(const Polyline& line, double width);

/// The place on a line nearest to a point.
struct PlaceOnLine {
  Vec3 point;
  double arc = 0;       ///< [cm]
  double distance = 0;  ///< [cm]
};
PlaceOnLine nearest_on(const Polyline& line, const Vec3& x);

/// The point at an arc length, and the line's unit direction there.
Vec3 point_at(const Polyline& line, double arc);
Vec3 direction_at(const Polyline& line, double arc);

}  // namespace tether
