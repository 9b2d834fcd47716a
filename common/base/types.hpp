#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tether {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using VectorXd = Eigen::VectorXd;
using MatrixXd = Eigen::MatrixXd;

/// One column a node: coordinates, displacements, velocities, forces.
using Points = Eigen::Matrix3Xd;

using Triangle = std::array<int, 3>;
using Tetrahedron = std::array<int, 4>;
using Prism = std::array<int, 6>;  ///< bottom triangle 0 1 2, top triangle 3 4 5, node i + 3 above node i

}  // namespace tether
