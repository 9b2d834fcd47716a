#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solid/materials/registry.hpp"
#include "solid/wall_model.hpp"
#include "tests/solid/inertia.hpp"
#include "tests/solid/report.hpp"
#include "tests/solid/tube.hpp"

// Frequencies of a beam and of a ring.
namespace tether {
namespace frequency_test {

constexpr double young = 1e6, density = 1.0, pi = std::numbers::pi;

SparseMatrix stiffness_matrix(const WallMesh& mesh, const Material& material) {
  const auto wall = make_wall_elements(mesh, mesh.points);
  VectorXd force = VectorXd::Zero(mesh.points.size());
  SparseMatrix tangent = wall->zero_matrix();
  wall->static_force(mesh.points, material, force, &tangent);
  return tangent;
}

/// Lowest frequency [1/time] of the modes to which `shape` belongs, by inverse iteration.
double lowest_frequency(const WallMesh& mesh, double poisson, const std::vector<int>& fixed, const Points& shape) {
  const auto material = neo_hookean.make(std::array{young, poisson});
  const auto wall = make_wall_elements(mesh, mesh.points);
  SparseMatrix k = stiffness_matrix(mesh, *material);
  constrain(k, fixed, k.coeff(0, 0));
  Cholesky cholesky;
  cholesky.analyze(k, 3);
  cholesky.factor(k);
  VectorXd mode = shape.reshaped();
  double square = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    VectorXd load = inertia(*wall, mesh.points, {&*material, 0, density}, mode);
    for (int unknown : fixed) load[unknown] = 0;
    const VectorXd next = cholesky.solve(load);
    square = next.dot(load) / next.dot(inertia(*wall, mesh.points, {&*material, 0, density}, next));
    mode = next.normalized();
  }
  return std::sqrt(square) / (2 * pi);
}

constexpr double beam_length = 10, beam_height = 0.2;

/// Bends about y; its width is two cells of `along` over the length.
WallMesh beam(int along) {
  return plate({beam_length, 2 * beam_length / along, beam_height}, {along, 2}, 1);
}

/// First frequency of a cantilever: Euler and Bernoulli's, cos(b) cosh(b) = -1, with Timoshenko's correction (1921) to
/// first order in (height/length)^2: rotary inertia and shear (Poisson's ratio 0, shear coefficient 5/6), both by the
/// mode's int phi'^2 / int phi^2 = s b (2 + s b).
double cantilever_frequency() {
  const double b = 1.875104068711961, square = beam_height * beam_height / 12;
  const double s = (std::sinh(b) - std::sin(b)) / (std::cosh(b) + std::cos(b)), slope = s * b * (2 + s * b);
  const double thin = b * b / (2 * pi * beam_length * beam_length) * std::sqrt(young * square / density);
  return thin * (1 - (1 + 2 / (5.0 / 6)) / 2 * slope * square / (beam_length * beam_length));
}

double beam_frequency_error(int along) {
  const WallMesh mesh = beam(along);
  Points shape = Points::Zero(3, mesh.points.cols());
  shape.row(2) = mesh.points.row(0).array().square();
  return lowest_frequency(mesh, 0, unknowns_of(nodes_of(mesh.rings[0].triangles)), shape) / cantilever_frequency() - 1;
}

TEST(Cantilever, FirstFrequencyIsTimoshenkos) {
  const double coarse = beam_frequency_error(12), middle = beam_frequency_error(24), fine = beam_frequency_error(48);
  report("cantilever_frequency", std::array{12, 24, 48}, std::array{coarse, middle, fine});
  EXPECT_LT(std::abs(coarse), 0.01);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.25);
  EXPECT_LT(std::abs(fine), 1e-4) << "one layer carries its shear uniformly, not as a parabola: 3e-5";
}

/// Breathing of a thin ring in plane strain, by Rayleigh's quotient of the displacement under its own inertia, against
/// omega^2 = E/((1 - nu^2) rho R^2), R of the middle surface.
double breathing_error(int around, double poisson) {
  const WallMesh mesh = tube_slice({around, 1, ElementKind::prism, 1.0 - 0.005, 0.01});
  const double exact = std::sqrt(young / ((1 - poisson * poisson) * density)) / (2 * pi);
  const auto material = neo_hookean.make(std::array{young, poisson});
  const auto wall = make_wall_elements(mesh, mesh.points);
  Points shape = mesh.points;
  shape.row(2).setZero();
  const VectorXd load = inertia(*wall, mesh.points, {&*material, 0, density}, shape.reshaped());
  const VectorXd y = linear_response(mesh, *material, load, plane_strain_supports(mesh)).reshaped();
  const double square = load.dot(y) / inertia(*wall, mesh.points, {&*material, 0, density}, y).dot(y);
  return std::sqrt(square) / (2 * pi) / exact - 1;
}

TEST(Ring, BreathesAtItsFrequency) {
  for (const double poisson : {0.3, 0.49}) {
    const double coarse = breathing_error(24, poisson), fine = breathing_error(48, poisson);
    report(fmt::format("ring_frequency_{}", poisson), std::array{24, 48}, std::array{coarse, fine});
    EXPECT_LT(std::abs(coarse), 0.01);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  }
}

}  // namespace frequency_test
}  // namespace tether
