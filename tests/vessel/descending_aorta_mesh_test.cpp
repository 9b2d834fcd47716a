#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "common/base/error.hpp"
#include "common/mesh/locator.hpp"
#include "common/mesh/surface.hpp"
#include "vessel/check.hpp"
#include "vessel/contours.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace {

const std::string folder = "configs/descending_aorta/cine_mr/";

SweptCase vessel_case() {
  SweptCase swept;
  swept.contours = ContoursCase{folder + "contours.csv", "mm"};
  swept.extend = {2.5, 2.5};
  swept.wall_thickness = 0.15;
  swept.around = 28;
  swept.along = 48;
  swept.angle_origin = {0, 1, 0};
  swept.regions = {{"spine", {{330, 30}, {0, 1}}}, {"vicinity", {{285, 75}, {0, 1}}}, {"opposite", {}}};
  return swept;
}

const VesselMesh& vessel() {
  static const VesselMesh mesh = [] {
    MeshCase mesh;
    mesh.swept = vessel_case();
    return load_mesh(mesh, UnitSystem::cgs(), WallElement::prism);
  }();
  return mesh;
}

TEST(DescendingAorta, IsOfAnAdultsSizeAndWellShaped) {
  const MeshReport r = report(vessel());
  RecordProperty("mesh", fmt::format("fluid {} nodes {} tets, ratio min {:.3f} mean {:.3f} dihedral {:.1f}; wall {} "
                                     "nodes {} prisms; diameter {:.3f} thickness "
                                     "{:.4f} volume {:.2f}",
                                     r.fluid_nodes, r.fluid_elements, r.fluid.min_radius_ratio,
                                     r.fluid.mean_radius_ratio, r.fluid.min_dihedral, r.wall_nodes, r.wall_elements,
                                     r.lumen_diameter, r.wall_thickness, r.lumen_volume));
  EXPECT_NEAR(r.lumen_diameter, 1.6, 0.1);
  EXPECT_NEAR(r.wall_thickness, 0.15, 0.005);
  EXPECT_GT(r.fluid.min_radius_ratio, 0.28);
  EXPECT_GT(r.fluid.mean_radius_ratio, 0.6);
  EXPECT_GT(r.fluid.min_dihedral, 14.5);
}

/// The measured points lie on the lumen's surface, within what the facets cut off.
TEST(DescendingAorta, PassesThroughTheMeasuredContours) {
  const FluidMesh& fluid = vessel().fluid;
  const double h = 2 * std::numbers::pi * 0.85 / 28;
  for (const Points& contour : read_contours(folder + "contours.csv"))
    for (Eigen::Index i = 0; i < contour.cols(); ++i) {
      const Vec3 x = 0.1 * contour.col(i);
      double distance = 1e9;
      for (const Triangle& t : fluid.interface) {
        const Vec3 centre = fluid.points(Eigen::all, t).rowwise().mean();
        if ((x - centre).norm() < 0.8 * h)
          distance = std::min(distance, std::abs((x - centre).dot(area_vector(fluid.points, t).normalized())));
      }
      EXPECT_LT(distance, 0.012);
    }
}

TEST(DescendingAorta, SpineIsPosteriorAndInletCranial) {
  const Points& points = vessel().wall.points;
  const auto& outside = vessel().wall.outside;
  const Vec3 inlet = centroid(vessel().fluid.points, vessel().fluid.inlets[0].triangles);
  const Vec3 outlet = centroid(vessel().fluid.points, vessel().fluid.outlets[0].triangles);
  EXPECT_GT(inlet[2], outlet[2] + 8);
  EXPECT_GT(centroid(points, outside[0].triangles)[1], centroid(points, outside[2].triangles)[1] + 1);
  const double area = total_area(points, outside[0].triangles);
  EXPECT_NEAR(area / (area + total_area(points, outside[1].triangles) + total_area(points, outside[2].triangles)),
              1.0 / 6, 0.03);
}

TEST(DescendingAorta, EndsAreFlatAndAcrossTheAxis) {
  for (const auto* patch : {&vessel().fluid.inlets[0], &vessel().fluid.outlets[0]}) {
    const Vec3 sum = total_area_vector(vessel().fluid.points, patch->triangles);
    EXPECT_NEAR(sum.norm(), total_area(vessel().fluid.points, patch->triangles), 1e-12);
  }
  const std::vector<Triangle>& ring = vessel().wall.rings[0].triangles;
  EXPECT_NEAR(total_area_vector(vessel().wall.points, ring).norm(), total_area(vessel().wall.points, ring), 1e-9);
}

TEST(DescendingAorta, IsMadeFromThreeSlices) {
  EXPECT_EQ(read_contours(folder + "contours.csv").size(), 3u);
}

}  // namespace
}  // namespace tether
