#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "solid/elements/wall_elements.hpp"
#include "solid/materials/registry.hpp"
#include "tests/solid/strains.hpp"
#include "tests/solid/walls.hpp"

// What every wall element must satisfy, with every material, on a mesh without any regularity.
namespace tether {
namespace {

constexpr double density = 1.3;

class ElementContract : public ::testing::TestWithParam<std::tuple<ElementKind, int>> {
 protected:
  ElementContract()
      : material_(entry().make(values_of_order_one(entry().declaration))),
        mesh_(with_elements(crumpled_plate(5), std::get<0>(GetParam()))),
        wall_(make_wall_elements(mesh_, mesh_.points)) {}

  const Registered<Material>& entry() const { return materials()[static_cast<std::size_t>(std::get<1>(GetParam()))]; }
  Eigen::Index size() const { return mesh_.points.size(); }
  Points noise(double amplitude) { return amplitude * random_.matrix(3, mesh_.points.cols()); }
  /// Large rotation, moderate strain.
  Points deformed() {
    const Mat3 turn = random_rotation(random_), stretch = random_gradient(random_, 0.15);
    return turn * (stretch * mesh_.points + noise(0.03));
  }
  double strain_energy(const Points& x) const { return wall_->energy(x, *material_); }
  VectorXd static_force(const Points& x) const {
    VectorXd force = VectorXd::Zero(size());
    wall_->static_force(x, *material_, force, nullptr);
    return force;
  }
  VectorXd step_force(const StepMotion& motion, double viscosity, SparseMatrix* tangent = nullptr) const {
    VectorXd force = VectorXd::Zero(size());
    wall_->step_force(motion, {&*material_, viscosity, density}, force, tangent);
    return force;
  }

  Random random_{7};
  std::unique_ptr<Material> material_;
  WallMesh mesh_;
  std::unique_ptr<WallElements> wall_;
};

/// Walls with fibres of no stiffness are computed one element after the other, others four at once where they can be.
TEST_P(ElementContract, FourAtOnceAnswerAsOneAfterTheOther) {
  if (!mesh_.prisms.empty()) mesh_.prisms.resize(4 * (mesh_.prisms.size() / 4) - 3);  // the last is alone
  wall_ = make_wall_elements(mesh_, mesh_.points);
  const std::size_t elements = mesh_.prisms.empty() ? mesh_.tetrahedra.size() : mesh_.prisms.size();
  wall_->set_places(std::vector<ElementPlace>(elements, {0, Vec3::UnitZ(), Vec3::UnitX()}));
  const Points start = deformed(), velocity = noise(1), acceleration = noise(1);
  const auto answer = [&](const std::vector<Fibres>& fibres, bool with_tangent) {
    wall_->set_local({{.stiffness = 1.7, .thickness = 0.6, .tension = 0.1, .fibres = fibres}});
    SparseMatrix tangent = wall_->zero_matrix();
    const VectorXd force =
        step_force({start, velocity, acceleration, 0.6, 0.02, false}, 0.3, with_tangent ? &tangent : nullptr);
    return std::tuple(force, tangent, wall_->cauchy_stress(start, *material_));
  };
  const std::vector<Fibres> no_stiffness{{.stiffness = 0, .exponent = 1, .angle = 0.3}};
  const auto [force, tangent, stress] = answer({}, true);
  const auto [clear_force, clear_tangent, clear_stress] = answer(no_stiffness, true);
  EXPECT_LE((force - clear_force).norm(), 1e-12 * force.norm());
  EXPECT_LE((tangent - clear_tangent).norm(), 1e-12 * tangent.norm());
  EXPECT_LE((stress - clear_stress).norm(), 1e-12 * stress.norm());
  EXPECT_LE((std::get<0>(answer({}, false)) - force).norm(), 1e-13 * force.norm());
}

TEST_P(ElementContract, RigidMotionCostsNothing) {
  const Points moved = (random_rotation(random_) * mesh_.points).colwise() + Vec3(3, -2, 5);
  EXPECT_NEAR(strain_energy(moved), 0, 1e-13);
  EXPECT_LE(static_force(moved).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST_P(ElementContract, ForceIsTheDerivativeOfTheEnergy) {
  const Points x = deformed();
  const VectorXd force = static_force(x);
  for (int sample = 0; sample < 6; ++sample) {
    const Points direction = noise(1);
    const double slope = derivative([&](double t) { return strain_energy(x + t * direction); }, 2e-4);
    EXPECT_NEAR(force.dot(direction.reshaped()), slope, 1e-8 * force.norm());
  }
}

TEST_P(ElementContract, ForcesAreBalanced) {
  const Points x = deformed();
  const Points force = static_force(x).reshaped(3, x.cols());
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index node = 0; node < x.cols(); ++node) moment += x.col(node).cross(force.col(node));
  EXPECT_LE(force.rowwise().sum().norm(), 1e-12 * force.norm());
  EXPECT_LE(moment.norm(), 1e-11 * force.norm());
}

TEST_P(ElementContract, StaticTangentIsTheDerivativeOfTheForceAndSymmetric) {
  const Points x = deformed();
  VectorXd force = VectorXd::Zero(size());
  SparseMatrix tangent = wall_->zero_matrix();
  wall_->static_force(x, *material_, force, &tangent);
  EXPECT_LE((force - static_force(x)).norm(), 1e-12 * force.norm()) << "the force with and without tangent";
  EXPECT_LE((tangent - SparseMatrix(tangent.transpose())).norm(), 1e-13 * tangent.norm());
  for (int sample = 0; sample < 3; ++sample) {
    const Points direction = noise(1);
    const VectorXd expected = derivative([&](double t) { return static_force(x + t * direction); }, 2e-4);
    EXPECT_LE((tangent * direction.reshaped() - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST_P(ElementContract, StepTangentIsTheDerivativeByTheVelocity) {
  const Points start = deformed(), velocity = noise(1), before = noise(1);
  const double dt = 0.02;
  for (const double theta : {0.5, 0.55, 1.0}) {
    const auto force_at = [&](const Points& v, SparseMatrix* tangent) {
      const Points acceleration = (v - before) / (theta * dt);
      return step_force({start, v, acceleration, theta, dt, false}, 0, tangent);
    };
    SparseMatrix tangent = wall_->zero_matrix();
    force_at(velocity, &tangent);
    const Points direction = noise(1);
    const VectorXd expected = derivative([&](double t) { return force_at(velocity + t * direction, nullptr); }, 1e-2);
    EXPECT_LE((tangent * direction.reshaped() - expected).norm(), 1e-8 * expected.norm()) << theta;
  }
}

/// With viscosity or energy conservation the exact tangent has a small part without symmetry, of the size of the step's
/// strain: it is left out, and vanishes in proportion to the step.
TEST_P(ElementContract, SymmetricStepTangentApproachesTheDerivativeWithTheStep) {
  const Points start = deformed(), velocity = noise(1), none = Points::Zero(3, start.cols()), direction = noise(1);
  for (const bool conserving : {false, true}) {
    std::vector<double> errors;
    for (const double dt : {4e-3, 2e-3, 1e-3}) {
      const double viscosity = conserving ? 0 : 0.5;
      const auto force_at = [&](const Points& v, SparseMatrix* tangent) {
        return step_force({start, v, none, 0.5, dt, conserving}, viscosity, tangent);
      };
      SparseMatrix tangent = wall_->zero_matrix(), mass = wall_->zero_matrix();
      force_at(velocity, &tangent);
      EXPECT_LE((tangent - SparseMatrix(tangent.transpose())).norm(), 1e-13 * tangent.norm());
      const Points still = Points::Zero(3, start.cols());
      VectorXd ignored = VectorXd::Zero(size());
      const VectorXd inertia =
          step_force({start, velocity, direction, 0.5, dt, conserving}, viscosity) - force_at(velocity, nullptr);
      const VectorXd expected = derivative([&](double t) { return force_at(velocity + t * direction, nullptr); }, 1e-2);
      const VectorXd coded = tangent * direction.reshaped() - inertia / (0.5 * dt);
      errors.push_back((coded - expected).norm() / expected.norm());
    }
    EXPECT_LT(errors[0], 0.05) << conserving;
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(errors[i] / errors[i + 1]), 1, 0.1) << conserving;
  }
}

TEST_P(ElementContract, MidpointStepWithoutSpeedIsStatic) {
  const Points x = deformed(), none = Points::Zero(3, x.cols());
  for (const bool conserving : {false, true})
    EXPECT_LE((step_force({x, none, none, 0.5, 1e-3, conserving}, 0.5) - static_force(x)).norm(),
              1e-12 * static_force(x).norm());
}

TEST_P(ElementContract, ConservingForceDoesTheWorkOfTheEnergyDifference) {
  const Points start = deformed(), none = Points::Zero(3, start.cols());
  for (const double change : {0.03, 1e-2, 1e-4, 1e-6}) {
    const Points velocity = noise(change);
    const VectorXd force = step_force({start, velocity, none, 0.5, 1.0, true}, 0);
    const double stored = strain_energy(start + velocity) - strain_energy(start);
    EXPECT_NEAR(force.dot(velocity.reshaped()), stored, 1e-13 * strain_energy(start)) << change;
  }
}

/// The correction to the mid-strain stress is of second order; rounding in the energies must not enlarge it when little
/// moves.
TEST_P(ElementContract, ConservingForceStaysCloseToTheMidpointRule) {
  const Points start = deformed(), none = Points::Zero(3, start.cols()), direction = noise(1);
  for (double change = 1e-2; change > 1e-14; change *= 0.1) {
    const Points velocity = change * direction;
    const VectorXd conserving = step_force({start, velocity, none, 0.5, 1.0, true}, 0);
    const VectorXd midpoint = step_force({start, velocity, none, 0.5, 1.0, false}, 0);
    EXPECT_LE((conserving - midpoint).norm(), (100 * change * change + 1e-9) * midpoint.norm()) << change;
  }
}

TEST_P(ElementContract, ViscosityDissipates) {
  const Points start = deformed(), velocity = noise(1), none = Points::Zero(3, start.cols());
  const auto power = [&](const Points& v) {
    const StepMotion motion{start, v, none, 0.5, 1e-3, false};
    return (step_force(motion, 0.5) - step_force(motion, 0)).dot(v.reshaped());
  };
  EXPECT_GT(power(velocity), 0);
  const Mat3 spin = (Mat3() << 0, 1, -2, -1, 0, 3, 2, -3, 0).finished();
  const Points turning = spin * (start + 0.5e-3 * spin * start);  // to first order in the step
  EXPECT_LE(power(turning), 1e-4 * power(velocity)) << "rigid rotation is not resisted";
}

TEST_P(ElementContract, InertiaHasTheMassAndMomentumOfTheVolume) {
  const Points rest = mesh_.points, none = Points::Zero(3, rest.cols());
  const Points uniform = Vec3(1, -2, 3).replicate(1, rest.cols());
  const auto inertia = [&](const Points& acceleration) -> Points {
    return step_force({rest, none, acceleration, 0.5, 1e-3, false}, 0).reshaped(3, rest.cols());
  };
  const Vec3 total = inertia(uniform).rowwise().sum(), expected = density * wall_->volume() * Vec3(1, -2, 3);
  EXPECT_LE((total - expected).norm(), 1e-12 * expected.norm());
  const Points acceleration = noise(1);
  EXPECT_GT(inertia(acceleration).cwiseProduct(acceleration).sum(), 0);
  EXPECT_NEAR(inertia(acceleration).cwiseProduct(uniform).sum(), inertia(uniform).cwiseProduct(acceleration).sum(),
              1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, ElementContract,
                         testing::Combine(::testing::Values(ElementKind::prism, ElementKind::tetrahedron),
                                          ::testing::Range(0, static_cast<int>(materials().size()))),
                         [](const auto& info) {
                           return std::string(name_of(std::get<0>(info.param))) + "_" +
                                  materials()[static_cast<std::size_t>(std::get<1>(info.param))].declaration.name;
                         });

TEST(Elements, AnElementWithoutVolumeIsNamed) {
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron}) {
    const WallMesh mesh = with_elements(plate({1, 1, 0.1}, {2, 2}, 1), kind);
    Points flat = mesh.points;
    flat.row(2).setZero();
    EXPECT_THROW(make_wall_elements(mesh, flat), RunError);
  }
}

}  // namespace
}  // namespace tether
