#include <gtest/gtest.h>

#include "common/mesh/surface.hpp"
#include "solid/initial_stress.hpp"
#include "solid/materials/registry.hpp"
#include "solid/prestress.hpp"
#include "solid/solid_solver.hpp"
#include "solid/wall_share.hpp"
#include "tests/solid/differences.hpp"
#include "tests/solid/strains.hpp"
#include "tests/solid/tube.hpp"

// The stress with which an imaged wall carries the image's pressure. Units: cm, g, s; 80 mmHg.
namespace tether {
namespace initial_stress_test {

constexpr double pressure = 80 * 1333.22, radius = 1.0, thickness = 0.16, young = 4e6, poisson = 0.45;

std::unique_ptr<Material> neo(double modulus = young) {
  return neo_hookean.make(std::array{modulus, poisson});
}

/// `stretch` widens the section along y: an ellipse.
WallMesh vessel(double stretch = 1, int around = 24) {
  WallMesh wall = circular_tube(radius, 3, thickness, around, around / 3).wall;
  wall.points.row(1) *= stretch;
  return wall;
}

/// Hoop stress of each element, for sections nearly round.
Eigen::VectorXd hoop_stress(const WallMesh& wall, const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress) {
  Eigen::VectorXd hoop(stress.cols());
  for (Eigen::Index e = 0; e < stress.cols(); ++e) {
    Vec3 centre = Vec3::Zero();
    for (int node : wall.prisms[static_cast<std::size_t>(e)]) centre += wall.points.col(node) / 6;
    const Vec3 around = Vec3(-centre[1], centre[0], 0).normalized();
    hoop[e] = around.dot(to_tensor(stress.col(e)) * around);
  }
  return hoop;
}

WallModel* prestressed(std::unique_ptr<WallModel>& model, const WallMesh& wall) {
  const WallSettings settings{.material = "neo_hookean", .material_values = {young, poisson}, .density = 1.2};
  std::vector<int> clamped;
  for (const Patch& ring : wall.rings)
    for (int node : nodes_of(ring.triangles)) clamped.push_back(node);
  model = std::make_unique<WallModel>(wall, settings, wall.points, clamped, std::vector<SurfaceSupport>{});
  model->set_initial_stress(find_initial_stress(wall, model->material(), pressure, wall_share(wall, alone())));
  return model.get();
}

TEST(InitialStress, OfARoundTubeIsLaplacesAndLeavesHardlyAnythingToTheSurroundings) {
  const WallMesh wall = vessel();
  const InitialStress initial = find_initial_stress(wall, *neo(), pressure, wall_share(wall, alone()));
  EXPECT_LT(initial.held_share, 0.02);  // the axial pull at the ends: a long tube hardly shortens (plane strain)
  const auto elements = make_wall_elements(wall, wall.points);
  elements->set_initial_stress(initial.virtual_displacement, *neo());
  const auto hoop = hoop_stress(wall, elements->cauchy_stress(wall.points, *neo()));
  const double laplace = pressure * radius / thickness;
  EXPECT_NEAR(hoop.mean() / laplace, 1, 0.02);
  EXPECT_LT((hoop.array() - hoop.mean()).abs().maxCoeff() / laplace, 0.05);
}

class InitialStressOfAnySize : public ::testing::TestWithParam<double> {};

TEST_P(InitialStressOfAnySize, DoesNotDependOnTheModulus) {
  WallMesh wall = vessel(1.05);
  wall.points *= GetParam();
  const auto stress = [&](double modulus) {
    const auto elements = make_wall_elements(wall, wall.points);
    elements->set_initial_stress(
        find_initial_stress(wall, *neo(modulus), pressure, wall_share(wall, alone())).virtual_displacement,
        *neo(modulus));
    return elements->cauchy_stress(wall.points, *neo(modulus));
  };
  const auto softest = stress(2e4), soft = stress(1e6),
             stiff = stress(1e7);  // the softest would be crushed: it is not asked to
  EXPECT_LT((soft - stiff).cwiseAbs().maxCoeff(), 1e-9 * stiff.cwiseAbs().maxCoeff());
  EXPECT_LT((softest - stiff).cwiseAbs().maxCoeff(), 1e-9 * stiff.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(FromAChildsBranchToAnAorta, InitialStressOfAnySize, ::testing::Values(0.05, 1.0));

/// What an elliptic section needs beside tension is bending; the wall is not given it.
TEST(InitialStress, OfAnEllipseStaysNearTensionAndTheSurroundingsHoldTheShape) {
  for (const double stretch : {1.05, 1.1, 1.2}) {
    const WallMesh wall = vessel(stretch);
    const InitialStress initial = find_initial_stress(wall, *neo(), pressure, wall_share(wall, alone()));
    const double ellipticity = (stretch - 1) / 2;
    EXPECT_GT(initial.held_share, ellipticity);  // 3 eps cos(2 theta) of the pressure if tension is uniform
    EXPECT_LT(initial.held_share, 4 * ellipticity);
    const Points forces = initial.held;
    EXPECT_LT(forces.rowwise().sum().norm(), 1e-2 * forces.colwise().norm().sum());
  }
}

TEST(InitialStress, IsTheDerivativeOfItsEnergyAndHasATangent) {
  const WallMesh wall = vessel(1.1, 12);
  const auto elements = make_wall_elements(wall, wall.points);
  elements->set_initial_stress(
      find_initial_stress(wall, *neo(), pressure, wall_share(wall, alone())).virtual_displacement, *neo());
  Points x = wall.points;
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += 0.01 * std::sin(7.0 * static_cast<double>(i));
  VectorXd force = VectorXd::Zero(x.size()), direction(x.size());
  SparseMatrix tangent = elements->zero_matrix();
  elements->static_force(x, *neo(), force, &tangent);
  for (Eigen::Index i = 0; i < x.size(); ++i) direction[i] = std::cos(3.0 * static_cast<double>(i));
  const double step = 1e-6;
  const Points forward = x + step * direction.reshaped(3, x.cols()), back = x - step * direction.reshaped(3, x.cols());
  const double slope = (elements->energy(forward, *neo()) - elements->energy(back, *neo())) / (2 * step);
  EXPECT_NEAR(slope / force.dot(direction), 1, 1e-6);
  VectorXd f1 = VectorXd::Zero(x.size()), f0 = f1;
  elements->static_force(forward, *neo(), f1, nullptr);
  elements->static_force(back, *neo(), f0, nullptr);
  const VectorXd product = tangent * direction;
  EXPECT_LT(((f1 - f0) / (2 * step) - product).norm(), 1e-6 * product.norm());
}

TEST(InitialStress, LeavesTheImagedWallAtRestWhateverItsShape) {
  for (const double stretch : {1.0, 1.2}) {
    const WallMesh wall = vessel(stretch);
    std::unique_ptr<WallModel> model;
    SolidSolver solver(*prestressed(model, wall));
    const VectorXd forces = uniform_pressure_forces(wall, wall.points, pressure);
    const Points load = forces.reshaped(3, wall.points.cols()).leftCols(wall.interface_nodes);
    for (int step = 0; step < 5; ++step) {
      solver.begin_step(1e-3 * step, 1e-3);
      solver.evaluate(load);
      solver.accept();
    }
    EXPECT_LE(solver.largest_displacement(), 1e-9 * radius);
  }
}

/// A wall under tension resists change of shape as a drum's skin does. A ring in plane strain that gives way to p1
/// cos(n theta) without stretching, w = a cos(n theta), v = -a/n sin(n theta), turns by (n - 1/n) a/R sin(n theta): the
/// tension N = p R adds N (n^2 - 1)^2/(n R)^2 to the stiffness (n^2 - 1)^2 D/R^4 of bending. The pressure's forces are
/// dead here.
TEST(InitialStress, TensionStiffensTheSectionAgainstOvalisation) {
  const WallMesh wall = tube_slice({.around = 48, .layers = 1, .radius = radius, .thickness = 0.08});
  const auto material = neo();
  const double size = 1.0;
  const auto oval = [&](bool tension) {
    auto elements = make_wall_elements(wall, wall.points);
    VectorXd held = VectorXd::Zero(wall.points.size());
    VectorXd dead = uniform_pressure_forces(wall, wall.points, pressure);
    if (tension) {
      const InitialStress initial = find_initial_stress(wall, *material, pressure, wall_share(wall, alone()));
      elements->set_initial_stress(initial.virtual_displacement, *material);
      held = initial.held.reshaped();
    } else {
      dead.setZero();
    }
    const VectorXd load = dead + pressure_forces(wall, [&](double theta) { return size * std::cos(2 * theta); });
    SparseMatrix tangent = elements->zero_matrix();
    VectorXd internal = VectorXd::Zero(wall.points.size());
    elements->static_force(wall.points, *material, internal, &tangent);
    VectorXd difference = load - internal + held;
    const std::vector<int> fixed = plane_strain_supports(wall);
    constrain(tangent, fixed, tangent.coeff(0, 0));
    for (int unknown : fixed) difference[unknown] = 0;
    Cholesky factor;
    factor.analyze(tangent, 3);
    factor.factor(tangent);
    const VectorXd u = factor.solve(difference);
    return u[3 * node_toward(wall, {1, 0, 0})];
  };
  const double middle = radius + 0.04, bending = young / (1 - poisson * poisson) * std::pow(0.08, 3) / 12;
  EXPECT_NEAR(oval(false) * 9 * bending / std::pow(middle, 4), 1, 0.12);
  const double resistance = 1 / oval(true) - 1 / oval(false), tension = pressure * radius;
  EXPECT_NEAR(resistance / (tension / (middle * middle)), 9.0 / 4, 0.06 * 9 / 4);
}

}  // namespace initial_stress_test
}  // namespace tether
