#include "fsi_master/transfer/interface_surface.hpp"

#include "common/mesh/surface.hpp"

namespace tether {

double diagonal(const Points& points) {
  return points.cols() == 0 ? 0.0 : (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

VectorXd nodal_areas(const InterfaceSurface& surface) {
  return nodal_areas(surface.points, surface.triangles);
}

}  // namespace tether
