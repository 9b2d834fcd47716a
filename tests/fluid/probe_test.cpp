#include "fluid/probe.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "common/base/error.hpp"
#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

TEST(Probe, InterpolatesALinearFieldExactly) {
  const FluidMesh mesh = box_vessel({1, 2, 3}, {2, 3, 4});
  const Vec3 slope(3, -2, 7);
  const VectorXd field = (slope.transpose() * mesh.points).transpose().array() + 5;
  for (const Vec3& x : {Vec3(0.31, 1.27, 2.13), Vec3(0.5, 0.1, 0), Vec3(1, 2, 3), Vec3(0, 0, 0.7)})
    EXPECT_NEAR(place_probe("here", x, mesh).value(field), slope.dot(x) + 5, 1e-13);
}

TEST(Probe, OutsideTheBloodIsAnErrorWithItsDistance) {
  const FluidMesh mesh = box_vessel({1, 2, 3}, {2, 3, 4});
  const auto message = [&](const Vec3& x) -> std::string {
    try {
      place_probe("there", x, mesh);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message({1.25, 1, 1}), "(1.25, 1, 1) lies outside the blood, 0.25 from its surface");
  EXPECT_EQ(message({0.5, 1, 3.5}), "(0.5, 1, 3.5) lies outside the blood, 0.5 from its surface");
  EXPECT_EQ(message({-0.3, -0.4, 1}), "(-0.3, -0.4, 1) lies outside the blood, 0.5 from its surface");
}

/// Nodes keep their pressure when the wall moves, and so does a probe on one; between nodes it is their mean.
TEST(Probe, MovesWithTheMesh) {
  FluidMesh mesh = tube(1, 2, 12, 6);
  FluidSettings chosen = settings(1.06, 0.04);
  const int node = 40;
  const Tetrahedron element = mesh.tetrahedra[200];
  chosen.probes = {{"node", mesh.points.col(node)}, {"centre", mesh.points(Eigen::all, element).rowwise().mean()}};
  FluidSolver solver(std::move(mesh), chosen);
  Points wider = solver.domain().sigma.local(solver.domain().mesh().points);
  wider.row(2).setZero();
  step(solver, 0, 0.01, 0.1 * wider, 10 * wider);
  EXPECT_GT(std::abs(solver.pressure()[node]), 1);
  EXPECT_NEAR(observed(solver, "node.pressure"), solver.pressure()[node], 1e-10 * std::abs(solver.pressure()[node]));
  EXPECT_NEAR(observed(solver, "centre.pressure"), solver.pressure()(element).mean(), 1e-8);
}

/// In a box whose nodes have moved: exact for a linear field, on nodes and faces too, and nothing outside.
TEST(Probe, TellsAVelocityAtPlacesOfSpace) {
  const FluidMesh mesh = box_vessel({1, 2, 3}, {4, 5, 6});
  const Mat3 stretch{{1.1, 0.1, 0}, {0, 0.9, 0.2}, {0, 0, 1.3}}, slope{{3, -2, 7}, {1, 0, 4}, {-5, 2, 1}};
  const Points now = stretch * mesh.points, field = slope * now;
  Points places = stretch * ((random_points(3 * 500, 0.5, 3).array() + 0.5).reshaped(3, 1500)).matrix();
  places.row(1) *= 2, places.row(2) *= 1;
  places.conservativeResize(3, 1502);
  places.col(1500) = now.col(17);
  places.col(1501) = stretch * Vec3(0.5, 1, 3.001);
  const Points found = vectors_in_space(places, now, mesh.tetrahedra, field);
  int inside = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Vec3 home = stretch.inverse() * places.col(i);
    const bool is_inside = (home.array() > -1e-9).all() && (home.array() < Eigen::Array3d(1, 2, 3) + 1e-9).all();
    inside += is_inside;
    if (is_inside)
      EXPECT_LT((found.col(i) - slope * places.col(i)).norm(), 1e-12) << home.transpose();
    else
      EXPECT_TRUE(found.col(i).array().isNaN().all()) << home.transpose();
  }
  EXPECT_GT(inside, 300);
}

}  // namespace
}  // namespace tether::fluid::testing
