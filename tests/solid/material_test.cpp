#include <gtest/gtest.h>

#include "common/base/configured.hpp"
#include "solid/materials/registry.hpp"
#include "tests/solid/strains.hpp"

// What every material law must satisfy, run over the registry.
namespace tether {
namespace {

class MaterialContract : public ::testing::TestWithParam<int> {
 protected:
  const Registered<Material>& entry() const { return materials()[static_cast<std::size_t>(GetParam())]; }
  std::vector<double> values() const { return values_of_order_one(entry().declaration); }
  std::unique_ptr<Material> material() const { return entry().make(values()); }
  double value(const std::string& name) const {
    for (std::size_t i = 0; i < entry().declaration.parameters.size(); ++i)
      if (entry().declaration.parameters[i].name == name) return values()[i];
    return undefined;
  }
};

TEST_P(MaterialContract, StressIsTheDerivativeOfTheEnergy) {
  const auto law = material();
  Random random(1);
  for (int sample = 0; sample < 20; ++sample) {
    const Voigt at = green_lagrange(random_gradient(random, 0.25)), s = stress(*law, at);
    for (int i = 0; i < 6; ++i) {
      const double slope = derivative([&](double t) { return energy(*law, at + t * Voigt::Unit(i)); }, 1e-3);
      EXPECT_NEAR(s[i], slope, 1e-8 * (1 + s.norm()));
    }
  }
}

TEST_P(MaterialContract, TangentIsTheDerivativeOfTheStressAndSymmetric) {
  const auto law = material();
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    const Voigt at = green_lagrange(random_gradient(random, 0.25));
    const auto [s, tangent] = stress_and_tangent(*law, at);
    EXPECT_LE((s - stress(*law, at)).norm(), 1e-14 * (1 + s.norm()));
    EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-14 * tangent.norm());
    for (int i = 0; i < 6; ++i) {
      const Voigt slope = derivative([&](double t) { return stress(*law, at + t * Voigt::Unit(i)); }, 1e-3);
      EXPECT_LE((tangent.col(i) - slope).norm(), 1e-8 * tangent.norm());
    }
  }
}

TEST_P(MaterialContract, AlongADirectionItAnswersTheSame) {
  const auto law = material();
  Random random(7);
  for (int sample = 0; sample < 20; ++sample) {
    const Voigt at = green_lagrange(random_gradient(random, 0.25)), direction = random.matrix(6, 1);
    const auto [s, tangent] = stress_and_tangent(*law, at);
    const auto [force, stiffness] = along(direction, *law, at);
    EXPECT_NEAR(force, direction.dot(s), 1e-13 * (1 + s.norm()) * direction.norm());
    EXPECT_NEAR(stiffness, direction.dot(tangent * direction), 1e-13 * tangent.norm() * direction.squaredNorm());
  }
}

TEST_P(MaterialContract, UnstrainedItHasNeitherEnergyNorStress) {
  const auto law = material();
  EXPECT_NEAR(energy(*law, Voigt::Zero()), 0, 1e-15);
  EXPECT_LE(stress(*law, Voigt::Zero()).norm(), 1e-15);
}

TEST_P(MaterialContract, EnergyIsPositiveNearTheUnstrainedState) {
  const auto law = material();
  Random random(3);
  for (int sample = 0; sample < 50; ++sample) {
    const Voigt e = green_lagrange(random_gradient(random, 0.1));
    EXPECT_GT(energy(*law, e), 0) << e.transpose();
  }
}

TEST_P(MaterialContract, SmallStrainTangentHasTheDeclaredModuli) {
  const double young = value("young"), poisson = value("poisson");
  double shear = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));
  if (std::isfinite(value("c1"))) shear = 2 * (value("c1") + value("c2")), bulk = value("bulk");
  if (std::isfinite(value("k1"))) shear = 2 * (value("k1") + value("k2")), bulk = value("bulk");
  ASSERT_TRUE(std::isfinite(shear) && std::isfinite(bulk)) << "say here what the new law's moduli are";
  Voigt66 expected = Voigt66::Zero();
  expected.topLeftCorner<3, 3>().setConstant(bulk - 2 * shear / 3);
  expected.diagonal() += (Voigt() << 2, 2, 2, 1, 1, 1).finished() * shear;
  const Voigt66 tangent = stress_and_tangent(*material(), Voigt::Zero()).tangent;
  EXPECT_LE((tangent - expected).norm(), 1e-13 * expected.norm());
}

TEST_P(MaterialContract, KnowsNoPreferredDirection) {
  const auto law = material();
  Random random(4);
  for (int sample = 0; sample < 10; ++sample) {
    const Mat3 f = random_gradient(random, 0.25), turn = random_rotation(random);
    const Voigt e = green_lagrange(f), turned = green_lagrange(f * turn);
    const Mat3 expected = turn.transpose() * to_tensor(stress(*law, e)) * turn;
    EXPECT_NEAR(energy(*law, turned), energy(*law, e), 1e-13 * (1 + energy(*law, e)));
    EXPECT_LE((to_tensor(stress(*law, turned)) - expected).norm(), 1e-13 * (1 + expected.norm()));
  }
}

TEST_P(MaterialContract, RefusesValuesOutOfRangeAndUnknownNames) {
  EffectChoice choice{entry().declaration.name, {}};
  for (std::size_t i = 0; i < values().size(); ++i) choice.values[entry().declaration.parameters[i].name] = values()[i];
  Configured<Material> configured(materials(), choice);
  for (const Parameter& parameter : entry().declaration.parameters) {
    EXPECT_THROW(configured.set(parameter.name, parameter.range.lower - 1), InputError) << parameter.name;
    EXPECT_THROW(configured.set(parameter.name, undefined), InputError) << parameter.name;
    if (!std::isfinite(parameter.standard)) {
      EffectChoice silent = choice;
      silent.values.erase(parameter.name);
      EXPECT_THROW(Configured<Material>(materials(), silent), InputError) << parameter.name;
    }
  }
  EXPECT_THROW(configured.set("stiffnes", 1), InputError);
  EXPECT_EQ(configured.values(), values()) << "a refused value changes nothing";
}

INSTANTIATE_TEST_SUITE_P(Registry, MaterialContract, ::testing::Range(0, static_cast<int>(materials().size())),
                         [](const auto& info) {
                           return materials()[static_cast<std::size_t>(info.param)].declaration.name;
                         });

TEST(Materials, PoissonsRatioOfAnIncompressibleWallIsRefused) {
  const EffectChoice choice{"neo_hookean", {{"young", 1.0}, {"poisson", 0.5}}};
  EXPECT_THROW(Configured<Material>(materials(), choice), InputError);
}

}  // namespace
}  // namespace tether
