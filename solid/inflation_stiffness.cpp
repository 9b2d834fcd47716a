#include "solid/inflation_stiffness.hpp"

#include "common/mesh/surface.hpp"

namespace tether {

double inflation_stiffness(const WallMesh& mesh, const WallElements& wall, const Material& material) {
  const double area = total_area(mesh.points, mesh.interface), thickness = wall.volume() / area, d = 1e-4 * thickness;
  const Points moved = mesh.points + d * nodal_normals(mesh.points, mesh.interface);
  const double curvature = (total_area(moved, mesh.interface) - area) / (d * area);  // of a tube 1/R
  const Voigt66 C = stress_and_tangent(material, Voigt::Zero()).tangent;
  return (C(0, 0) - C(0, 1) * C(0, 1) / C(0, 0)) * thickness * curvature * curvature;
}

}  // namespace tether
