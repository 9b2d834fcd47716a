// How fast what goes over a curved interface of two triangulations becomes right.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/linalg/cholesky.hpp"
#include "common/mesh/surface.hpp"
#include "fsi_master/transfer/interface_map.hpp"
#include "tests/fsi_master/interface_tube.hpp"

namespace tether {
namespace {

/// A smooth field of vectors: a motion, or a traction.
VectorXd smooth(const Points& points) {
  Points values(3, points.cols());
  for (Eigen::Index a = 0; a < points.cols(); ++a) {
    const double angle = std::atan2(points(1, a), points(0, a)), s = 2 * std::numbers::pi * points(2, a) / tube_height;
    values.col(a) << std::cos(2 * angle) * std::sin(s), 1 + std::sin(angle + s), std::cos(s) * std::cos(3 * angle);
  }
  return values.reshaped();
}

/// The P1 mass of a surface, one number a node.
SparseMatrix mass_of(const InterfaceSurface& surface) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& t : surface.triangles) {
    const double area = area_vector(surface.points, t).norm();
    for (const int a : t)
      for (const int b : t) entries.emplace_back(a, b, area / (a == b ? 6 : 12));
  }
  SparseMatrix mass(surface.points.cols(), surface.points.cols());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

MatrixXd by_node(const VectorXd& values) {
  return Eigen::Map<const Points>(values.data(), 3, values.size() / 3).transpose();
}

/// In the mean of squares over a surface, relative to the second.
double difference(const SparseMatrix& mass, const MatrixXd& found, const MatrixXd& exact) {
  const auto norm = [&mass](const MatrixXd& v) { return std::sqrt((v.transpose() * (mass * v)).trace()); };
  return norm(found - exact) / norm(exact);
}

struct Errors {
  double motion;    ///< at the fluid, in the mean of squares
  double traction;  ///< at the solid: that of which its load is the integral
  double work;      ///< of the load in a smooth motion of the solid
};

Errors errors_of(const InterfaceMap& map, const InterfaceSurface& fluid, const InterfaceSurface& solid) {
  const SparseMatrix fluid_mass = mass_of(fluid), solid_mass = mass_of(solid);
  const std::vector<double> motion = map.to_fluid(smooth(solid.points));
  const VectorXd moved = Eigen::Map<const VectorXd>(motion.data(), static_cast<Eigen::Index>(motion.size()));
  const MatrixXd load = fluid_mass * by_node(smooth(fluid.points));
  const VectorXd forces = MatrixXd(load.transpose()).reshaped();
  const VectorXd received = map.to_solid({forces.begin(), forces.end()});
  Cholesky factor;
  factor.factor(solid_mass);
  MatrixXd traction = by_node(received);
  factor.solve_in_place(traction);
  const MatrixXd exact = by_node(smooth(solid.points));
  const double work = received.dot(smooth(solid.points)),
               exact_work = (exact.transpose() * (solid_mass * exact)).trace();
  return {difference(fluid_mass, by_node(moved), by_node(smooth(fluid.points))),
          difference(solid_mass, traction, exact), std::abs(work / exact_work - 1)};
}

/// Of each error, from the mesh of 32 nodes around the fluid to twice as many; the solid's are `finer` times as many.
template <class Map>
Errors orders_of(Map map, double finer) {
  const auto errors = [&](int n) {
    const int m = static_cast<int>(finer * n);
    const InterfaceSurface solid = tube(m, m / 2, 0.3), fluid = tube(n, n / 2, -0.5);
    return errors_of(map(fluid, solid, 0.5, UnitSystem::cgs()), fluid, solid);
  };
  const Errors coarse = errors(32), fine = errors(64);
  const auto order = [](double before, double after) { return std::log2(before / after); };
  return {order(coarse.motion, fine.motion), order(coarse.traction, fine.traction), order(coarse.work, fine.work)};
}

class TransferConvergence : public ::testing::TestWithParam<double> {};

TEST_P(TransferConvergence, TheMortarIsOfSecondOrderInMotionTractionAndWork) {
  const Errors orders = orders_of(InterfaceMap::mortar, GetParam());
  EXPECT_GT(orders.motion, 1.8);
  EXPECT_GT(orders.traction, 1.8);
  EXPECT_GT(orders.work, 1.8);
}

TEST_P(TransferConvergence, TheNearestTriangleIsOfSecondOrderInMotionAndWorkAlone) {
  const Errors orders = orders_of(InterfaceMap::nearest_triangle, GetParam());
  EXPECT_GT(orders.motion, 1.8);
  EXPECT_GT(orders.work, 1.8);
  EXPECT_LT(orders.traction, 0.5);  // the load of a node goes to the three around its place, however fine the solid
}

INSTANTIATE_TEST_SUITE_P(SolidNodesToOneOfTheFluid, TransferConvergence, ::testing::Values(0.6, 1.4, 3.0));

}  // namespace
}  // namespace tether
