#pragma once

#include "common/mesh/surface.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// A loop of border edges: an opening, or a hole.
struct Rim {
  std::vector<int> nodes;  ///< as the surface's triangles run through them
  Plane plane;             ///< the normal outward from the vessel
  double area = 0;         ///< of its projection on the plane [cm2]
  double off_plane = 0;    ///< greatest distance of a node from the plane [cm]
  int face_id = 0;         ///< of the cap that was taken off here, 0: none
  double radius() const;   ///< of the circle with that area [cm]
};

/// Largest first.
std::vector<Rim> rims_of(const RawSurface& surface);

/// The place in `rims`, of which there is one at least, of the rim whose middle is nearest.
std::size_t nearest_rim(const std::vector<Rim>& rims, const Vec3& x);

/// The same of a point that was picked for an opening: it is on it or near its rim, not further off than it is wide.
/// Throws PlacedError that begins with the field.
std::size_t rim_near(const std::vector<Rim>& rims, const Vec3& x, const std::string& field);

/// Takes the triangles with these ids off; the rims that are left know which. Throws InputError for one that is not
/// there.
std::vector<Rim> open_labels(RawSurface& surface, const std::vector<int>& ids);

/// Takes flat ends off a closed surface: regions in one plane, about as long as wide, behind an edge of more than 40
/// degrees. A note says how many.
void open_flat_ends(Repaired& state);

/// Cuts the part off that lies beyond a plane, where the plane's cut nearest to its origin is. Throws PlacedError if
/// the plane does not meet the surface, or that cut does not separate anything.
void cut_off(RawSurface& surface, const Plane& outward);

/// Makes each rim flat: one that nearly is so is moved onto its plane; another is cut off as little inward as makes all
/// of it flat. Throws PlacedError for a rim that is as deep as wide.
void flatten_rims(Repaired& state);

/// Closes a rim by triangles between its nodes.
void fill(RawSurface& surface, const Rim& rim, int face_id);

}  // namespace tether
