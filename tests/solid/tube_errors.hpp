#pragma once

#include "solid/materials/registry.hpp"
#include "tests/solid/tube.hpp"

/// How far a linear tube in plane strain is from its closed form.
namespace tether {

/// Errors of the lumen's displacement, relative; negative: too stiff.
struct TubeErrors {
  double inflation;    ///< under a uniform pressure, against Lame
  double ovalisation;  ///< under p cos(2 theta), against Michell
};

inline TubeErrors tube_errors(const TubeMesh& tube, const WallMesh& wall, double poisson) {
  const LinearTube reference{tube.radius, tube.radius + tube.thickness, 4e6, poisson};
  const auto material = neo_hookean.make(std::array{reference.young, poisson});
  const auto mode = [&](int n) {
    const VectorXd load = pressure_forces(wall, [n](double theta) { return std::cos(n * theta); });
    return radial_mode(wall, linear_response(wall, *material, load, plane_strain_supports(wall)), n);
  };
  return {mode(0) / lame_displacement(reference, 1, tube.radius) - 1,
          mode(2) / MichellOvalisation(reference, 1).radial_displacement(tube.radius) - 1};
}

inline TubeErrors tube_errors(const TubeMesh& tube, double poisson) {
  return tube_errors(tube, tube_slice(tube), poisson);
}

}  // namespace tether
