#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solid/materials/registry.hpp"
#include "solid/prestress.hpp"
#include "tests/solid/follower_pressure.hpp"
#include "tests/solid/report.hpp"
#include "tests/solid/tube.hpp"

// Finite inflation of a nearly incompressible neo-Hookean tube against the incompressible closed form.
namespace tether {
namespace inflation_test {

TEST(FollowerPressure, TangentIsTheDerivativeOfTheForce) {
  const WallMesh wall = tube_slice({8, 1});
  const auto elements = make_wall_elements(wall, wall.points);
  const StaticLoad load = follower_pressure(wall, 2.5, elements->zero_matrix());
  Random random(1);
  const Points x = wall.points + 0.1 * random.matrix(3, wall.points.cols()), direction = random.matrix(3, x.cols());
  const auto force_at = [&](const Points& at) {
    VectorXd force = VectorXd::Zero(x.size());
    load(at, force, nullptr);
    return force;
  };
  VectorXd force = VectorXd::Zero(x.size());
  SparseMatrix tangent = elements->zero_matrix();
  load(x, force, &tangent);
  const VectorXd slope = derivative([&](double t) { return force_at(x + t * direction); }, 1e-3);
  EXPECT_LE((tangent * direction.reshaped() + slope).norm(), 1e-10 * slope.norm());
  EXPECT_LE((force - uniform_pressure_forces(wall, x, 2.5)).norm(), 1e-14 * force.norm());
}

constexpr double shear = 1.0;

std::unique_ptr<Material> rubber(double poisson) {
  return neo_hookean.make(std::array{2 * shear * (1 + poisson), poisson});
}

constexpr double poisson = 0.49;
constexpr double bulk = 2 * shear * (1 + poisson) / (3 * (1 - 2 * poisson));

double inflated_stretch(const TubeMesh& mesh, double pressure) {
  const WallMesh wall = tube_slice(mesh);
  const Points x = inflate(wall, wall.points, *rubber(poisson), pressure, plane_strain_supports(wall));
  return 1 + radial_mode(wall, x - wall.points, 0) / mesh.radius;
}

/// Error of the inner displacement.
double error(const TubeMesh& mesh, double stretch) {
  const double p = CompressibleInflation(mesh.radius, mesh.radius + mesh.thickness, shear, bulk).pressure(stretch);
  return (inflated_stretch(mesh, p) - 1) / (stretch - 1) - 1;
}

TEST(InflationReferences, AgreeAsTheWallBecomesIncompressible) {
  for (const double stretch : {1.1, 1.5}) {
    const double closed = inflation_pressure(1, 1.5, shear, stretch);
    double defects[2];
    for (int i = 0; i < 2; ++i)
      defects[i] = CompressibleInflation(1, 1.5, shear, 1e3 * std::pow(10, i)).pressure(stretch) / closed - 1;
    EXPECT_LT(std::abs(defects[0]), 1e-3);
    EXPECT_NEAR(defects[0] / defects[1], 10, 0.05);
  }
}

TEST(FiniteInflation, PrismsFollowTheClosedForm) {
  for (const double stretch : {1.1, 1.3, 1.5}) {
    const double coarse = error({24, 2}, stretch), fine = error({48, 4}, stretch);
    report(fmt::format("finite_inflation_{}", stretch), std::array{24, 48}, std::array{coarse, fine});
    EXPECT_LT(std::abs(coarse), 0.03) << stretch;
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2) << stretch;
  }
}

TEST(FiniteInflation, ThickTube) {
  const TubeMesh coarse{24, 3, ElementKind::prism, 1.0, 0.5}, fine{48, 6, ElementKind::prism, 1.0, 0.5};
  const double first = error(coarse, 1.3), second = error(fine, 1.3);
  report("finite_inflation_thick_1.3", std::array{24, 48}, std::array{first, second});
  EXPECT_LT(std::abs(first), 0.03);
  EXPECT_NEAR(std::log2(first / second), 2, 0.2);
}

}  // namespace inflation_test
}  // namespace tether
