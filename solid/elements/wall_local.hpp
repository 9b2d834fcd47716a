#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Two families of fibres in the wall's plane, at +-angle from the direction around the vessel.
struct Fibres {
  double stiffness;  ///< k [pressure]
  double exponent;   ///< c
  double angle;      ///< [rad]
};

/// W = k/(2 c) (exp(c E^2) - 1) per family, E the strain along it; k/2 E^2 for c = 0. (S.20)
struct FibreResponse {
  double energy, stress, tangent;
};
FibreResponse fibre_response(const Fibres& fibres, double strain);

/// In what a part of the wall differs from the rest: what effects leave there.
struct WallLocal {
  double stiffness = 1;  ///< factor of the elastic stress
  double thickness = 1;  ///< factor of material per area
  double tension = 0;    ///< initial stress along the vessel [pressure]
  std::vector<Fibres> fibres;
  bool is_plain() const { return stiffness == 1 && thickness == 1 && tension == 0 && fibres.empty(); }
};

/// What is alike on average: of each of these so large a share; the shares add up to 1.
WallLocal mixture(const std::vector<WallLocal>& parts, const std::vector<double>& shares);

/// Where an element of the wall is.
struct ElementPlace {
  int zone;      ///< of the outer wall, or beyond these a mixture of them
  Vec3 outward;  ///< unit normal of the outer wall there
  Vec3 axial;    ///< unit, along the vessel, tangential (S.15); zero if not known
};

}  // namespace tether
