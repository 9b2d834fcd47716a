#include "fsi_master/transfer/interface_surface.hpp"

#include "common/mesh/surface.hpp"

namespace tether {

double diagonal(const Points& points) {
  return points.cols() == 0 ? 0.0 : (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

VectorXd nodal_areas(const InterfaceSurface& surface) {
  VectorXd areas = VectorXd::Zero(surface.points.cols());
  for (const Triangle& triangle : surface.triangles) {
    const double third = area_vector(surface.points, triangle).norm() / 3;
    for (const int node : triangle) areas(node) += third;
  }
  return areas;
}

}  // namespace tether
