// The element's closed-form integrals against quadrature of the weak form as it is written.
#include <gtest/gtest.h>

#include "fluid/advection_diffusion_element.hpp"
#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

Nodal some(unsigned seed, double size) {
  return random_points(4, size, seed);
}

TetGeometry skewed() {
  Nodal corners;
  corners << 0, 1, 0.2, 0.1, 0, 0.1, 0.9, 0.3, 0, -0.2, 0.1, 1.1;
  return tet_geometry(corners);
}

/// A rule on the reference tetrahedron, exact to degree 5, from Gauss points of the collapsed cube (weights add up to
/// 1).
std::vector<std::pair<Eigen::Vector4d, double>> quadrature() {
  const double points[] = {0.1127016653792583, 0.5, 0.8872983346207417}, weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  std::vector<std::pair<Eigen::Vector4d, double>> rule;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const double a = points[i], b = points[j] * (1 - a), c = points[k] * (1 - a - b);
        rule.push_back({{1 - a - b - c, a, b, c}, 6 * weights[i] * weights[j] * weights[k] * (1 - a) * (1 - a - b)});
      }
  return rule;
}

TEST(Geometry, GradientsAndVolumeOfALinearField) {
  const TetGeometry g = skewed();
  EXPECT_NEAR(g.grad_N.rowwise().sum().norm(), 0, 1e-14);
  EXPECT_GT(g.volume, 0);
  Nodal corners;
  corners << 0, 1, 0.2, 0.1, 0, 0.1, 0.9, 0.3, 0, -0.2, 0.1, 1.1;
  EXPECT_LT((corners * g.grad_N.transpose() - Mat3::Identity()).norm(), 1e-14);
}

TEST(Element, MatchesQuadratureOfTheWeakForm) {
  const double rho = 1.06, dt = 0.01;
  const TetGeometry g = skewed();
  const ElementFlow flow{some(1, 5), some(2, 2), some(3, 50), {3, -4, 1}, 0.04};
  const ElementSystem system = advection_diffusion(g, flow, rho, dt);

  const Nodal v0 = flow.velocity.colwise() - flow.carried, a_nodes = v0 - flow.mesh_velocity;
  const Vec3 a_mean = a_nodes.rowwise().mean();
  const double divergence = (flow.velocity * g.grad_N.transpose()).trace();
  const double tau = supg_time(dt, a_mean.norm(), element_size(g.volume), flow.viscosity / rho);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Nodal rhs = Nodal::Zero();
  for (const auto& [N, weight] : quadrature()) {
    const Vec3 a = a_nodes * N, known = v0 * N + dt * flow.acceleration * N;
    for (int i = 0; i < 4; ++i) {
      const double test =
          N[i] + tau * a_mean.dot(g.grad_N.col(i));  // SUPG tests the residual, which has no viscous part in P1
      for (int j = 0; j < 4; ++j) {
        const double residual = rho * (N[j] / dt + a.dot(g.grad_N.col(j)) + divergence / 2 * N[j]);
        matrix(i, j) += weight * g.volume * (test * residual + flow.viscosity * g.grad_N.col(i).dot(g.grad_N.col(j)));
      }
      rhs.col(i) += weight * g.volume * rho / dt * test * known;
    }
  }
  EXPECT_LT((system.matrix - matrix).norm(), 1e-13 * matrix.norm());
  EXPECT_LT((system.rhs - rhs).norm(), 1e-13 * rhs.norm());
}

TEST(Stabilisation, TimeHasItsThreeLimits) {
  EXPECT_NEAR(supg_time(1e-6, 1, 1, 1), 0.5e-6, 1e-15);
  EXPECT_NEAR(supg_time(1e9, 1e6, 0.1, 1e-6), 0.1 / 2e6, 1e-15);
  EXPECT_NEAR(supg_time(1e9, 1e-9, 0.1, 10), 0.01 / 120, 1e-12);
  EXPECT_NEAR(element_size(std::sqrt(2.0) / 12), 1, 1e-14);  // the regular tetrahedron of edge 1
}

}  // namespace
}  // namespace tether::fluid::testing
