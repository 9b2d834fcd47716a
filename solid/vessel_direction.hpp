#pragma once

#include "common/mesh/mesh.hpp"

namespace tether {

/// A number at each node of the wall that grows along the vessel, from 0 on its first ring to 1 on the others: the
/// harmonic function (S.15). Its gradient is the vessel's direction, also where it bends or branches. Throws InputError
/// for a wall without two rings.
VectorXd place_along_vessel(const WallMesh& mesh);

/// Unit gradient on a triangle of a function given at its corners, tangential to it; x: the corners, one column each.
Vec3 direction_on(const Mat3& x, const Vec3& values);

}  // namespace tether
