#pragma once

#include "common/mesh/topology.hpp"
#include "tests/vessel/anatomies/bifurcation.hpp"
#include "tests/vessel/anatomies/remesh.hpp"

namespace tether {

/// The bifurcation with flat caps.
inline LabelledSurface closed_bifurcation(double edge) {
  const Bifurcation vessel = bifurcation(edge);
  LabelledSurface closed{vessel.points, vessel.triangles, std::vector<int>(vessel.triangles.size(), 0), {}, 0};
  for (const std::vector<int>& rim : rims(vessel.triangles)) {
    const Vec3 centre = vessel.points(Eigen::all, rim).rowwise().mean();
    const int middle = static_cast<int>(closed.points.cols());
    closed.points.conservativeResize(3, middle + 1);
    closed.points.col(middle) = centre;
    closed.openings.push_back(centre[0] > 2 ? "side" : centre[2] < 1 ? "inlet" : "outlet");
    if (closed.openings.back() == "inlet") closed.inlet = static_cast<int>(closed.openings.size()) - 1;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      closed.triangles.push_back({rim[(i + 1) % rim.size()], rim[i], middle});
      closed.label.push_back(static_cast<int>(closed.openings.size()));
    }
  }
  return remeshed(closed, edge);
}

}  // namespace tether
