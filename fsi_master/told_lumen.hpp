#pragma once

#include "fsi_master/transfer/interface_map.hpp"

namespace tether {

/// The lumen that results tell of and measurements are set against: that of the case's mesh. Its nodes are the solid's
/// interface, or, where the solid is somebody else's code with nodes of its own, those of the fluid, which follow it.
struct ToldLumen {
  Points points;                      ///< in the image
  const InterfaceMap* map = nullptr;  ///< from the solid's nodes to these; none: they are these

  /// Displacements or velocities at the solid's nodes, x0 y0 z0 x1 ..., told of these.
  VectorXd of(const VectorXd& at_solid) const {
    if (map == nullptr) return at_solid;
    const std::vector<double> followed = map->to_fluid(at_solid);
    return Eigen::Map<const VectorXd>(followed.data(), static_cast<Eigen::Index>(followed.size()));
  }
};

}  // namespace tether
