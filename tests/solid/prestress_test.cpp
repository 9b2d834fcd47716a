#include <gtest/gtest.h>

#include "solid/materials/registry.hpp"
#include "solid/prestress.hpp"
#include "solid/solid_solver.hpp"
#include "solid/wall_share.hpp"
#include "tests/solid/follower_pressure.hpp"
#include "tests/solid/report.hpp"
#include "tests/solid/strains.hpp"
#include "tests/solid/tube.hpp"

// The stress-free wall of an imaged one. Units: cm, g, s; an aorta of radius 10 mm and wall 1.6 mm at 80 mmHg.
namespace tether {
namespace prestress_test {

constexpr double pressure = 80 * 1333.22, radius = 1.0, thickness = 0.16;

std::unique_ptr<Material> neo(double young, double poisson = 0.45) {
  return neo_hookean.make(std::array{young, poisson});
}

WallMesh straight_vessel() {
  return circular_tube(radius, 3, thickness, 16, 6).wall;
}

/// Bent, elliptic and of varying width.
WallMesh irregular_vessel() {
  WallMesh wall = straight_vessel();
  for (Eigen::Index node = 0; node < wall.points.cols(); ++node) {
    Vec3 x = wall.points.col(node);
    x.head<2>() *= 1 + 0.1 * std::sin(x[2]);
    x[1] *= 1.08;
    x[0] += 0.15 * x[2] * (3 - x[2]);
    wall.points.col(node) = x;
  }
  return wall;
}

std::vector<int> clamped_ends(const WallMesh& wall) {
  std::vector<int> nodes;
  for (const Patch& ring : wall.rings)
    for (int node : nodes_of(ring.triangles)) nodes.push_back(node);
  return nodes;
}

double out_of_balance(const WallMesh& wall, const Points& stress_free, const Material& material,
                      const std::vector<int>& fixed) {
  const VectorXd load = uniform_pressure_forces(wall, wall.points, pressure);
  VectorXd force = VectorXd::Zero(load.size());
  make_wall_elements(wall, stress_free)->static_force(wall.points, material, force, nullptr);
  VectorXd difference = load - force;
  for (int unknown : fixed) difference[unknown] = 0;
  return difference.lpNorm<Eigen::Infinity>() / load.lpNorm<Eigen::Infinity>();
}

/// Largest stretch of an edge of the lumen, less one.
double largest_edge_strain(const WallMesh& wall, const Points& stress_free) {
  double largest = 0;
  for (const Triangle& t : wall.interface)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const double before = (stress_free.col(a) - stress_free.col(b)).norm(),
                   now = (wall.points.col(a) - wall.points.col(b)).norm();
      largest = std::max(largest, now / before - 1);
    }
  return largest;
}

void expect_inflates_to_the_image(const WallMesh& wall, const Material& material, const std::vector<int>& fixed) {
  const StressFreeResult found = stress_free_configuration(wall, material, pressure, fixed, wall_share(wall, alone()));
  ASSERT_TRUE(found.converged) << found.iterations << " " << found.residual;
  EXPECT_LE(out_of_balance(wall, found.positions, material, fixed), 1e-5);
  const double strain = largest_edge_strain(wall, found.positions);
  EXPECT_GT(strain, 0.1);
  EXPECT_LT(strain, 0.45);
  const Points inflated = inflate(wall, found.positions, material, pressure, fixed, 1e-10);
  const double error = (inflated - wall.points).cwiseAbs().maxCoeff() / radius;
  report("stress_free_then_inflated", error);
  EXPECT_LE(error, 1e-6);
}

TEST(StressFreeConfiguration, OfASoftTubeInflatesToTheImage) {
  for (const double young : {4e6, 5e6}) {
    const WallMesh wall = straight_vessel();
    expect_inflates_to_the_image(wall, *neo(young), plane_strain_supports(wall));
  }
}

TEST(StressFreeConfiguration, OfAnIrregularVesselWithClampedEndsInflatesToTheImage) {
  const WallMesh wall = irregular_vessel();
  const std::vector<int> fixed = unknowns_of(clamped_ends(wall));
  expect_inflates_to_the_image(wall, *neo(6e6), fixed);
  expect_inflates_to_the_image(wall, *ciarlet_geymonat.make(std::array{0.75e6, 0.3e6, 2e7}), fixed);
  expect_inflates_to_the_image(with_elements(wall, ElementKind::tetrahedron), *neo(6e6), fixed);
}

/// Across any section through the axis the hoop stress carries the pressure: its mean is p a/t, whatever the law.
TEST(StressFreeConfiguration, CarriesThePressureByLaplacesLaw) {
  const WallMesh wall = straight_vessel();
  const StressFreeResult found =
      stress_free_configuration(wall, *neo(4e6), pressure, plane_strain_supports(wall), wall_share(wall, alone()));
  ASSERT_TRUE(found.converged);
  const auto stress = make_wall_elements(wall, found.positions)->cauchy_stress(wall.points, *neo(4e6));
  double hoop = 0;
  for (Eigen::Index e = 0; e < stress.cols(); ++e) {
    Vec3 centre = Vec3::Zero();
    for (int node : wall.prisms[static_cast<std::size_t>(e)]) centre += wall.points.col(node) / 6;
    const Vec3 around = Vec3(-centre[1], centre[0], 0).normalized();
    hoop += around.dot(to_tensor(stress.col(e)) * around) / static_cast<double>(stress.cols());
  }
  report("laplace_hoop_stress_error", hoop / (pressure * radius / thickness) - 1);
  EXPECT_NEAR(hoop / (pressure * radius / thickness), 1, 0.02);
}

TEST(StressFreeConfiguration, LeavesTheImagedWallAtRest) {
  const WallMesh wall = straight_vessel();
  const WallSettings settings{.material = "neo_hookean", .material_values = {4e6, 0.45}, .density = 1.2};
  const std::vector<int> nodes = clamped_ends(wall);
  const StressFreeResult found =
      stress_free_configuration(wall, *neo(4e6), pressure, unknowns_of(nodes), wall_share(wall, alone()));
  ASSERT_TRUE(found.converged);
  WallModel model(wall, settings, found.positions, nodes, {});
  SolidSolver solver(model);
  const VectorXd forces = uniform_pressure_forces(wall, wall.points, pressure);
  const Points load = forces.reshaped(3, wall.points.cols()).leftCols(wall.interface_nodes);
  for (int step = 0; step < 5; ++step) {
    solver.begin_step(1e-3 * step, 1e-3);
    solver.evaluate(load);
    solver.accept();
  }
  report("image_at_rest_displacement", solver.largest_displacement() / radius);
  EXPECT_LE(solver.largest_displacement(), 1e-8 * radius);
}

TEST(StressFreeConfiguration, NotFindingOneIsAResult) {
  const WallMesh wall = straight_vessel();
  const StressFreeResult found =
      stress_free_configuration(wall, *neo(1e5), pressure, plane_strain_supports(wall), wall_share(wall, alone()));
  EXPECT_FALSE(found.converged);
}

}  // namespace prestress_test
}  // namespace tether
