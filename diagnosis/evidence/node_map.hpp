#pragma once

#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/measured_run.hpp"

namespace tether {

/// Carries runs on another mesh of the same vessel over to the nodes of a lumen: each node by the displacement of the
/// closest place of the other imaged lumen.
class NodeMap {
 public:
  NodeMap(const LumenSurface& lumen, const LumenSurface& other);
  FinishedMotion operator()(const FinishedMotion& run) const;

 private:
  Points imaged_, rest_;      ///< of the lumen; of the other
  Eigen::Matrix3Xi corners_;  ///< of the other's triangle, of each node
  Points shares_;             ///< barycentric
};

}  // namespace tether
