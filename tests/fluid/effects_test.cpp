// Contracts that every registered rheology, outlet and inflow keeps.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/inlets/inflow.hpp"
#include "fluid/list_effects.hpp"
#include "fluid/outlets/outlet.hpp"
#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// Some admissible values: standards where there are, else ones that differ from each other.
std::vector<double> sample_values(const EffectDeclaration& declaration) {
  std::vector<double> values;
  for (const auto& p : declaration.parameters)
    values.push_back(std::isnan(p.standard) ? 0.04 * (1 + static_cast<double>(values.size())) : p.standard);
  return values;
}

template <class Physics>
void expect_declared_well(std::span<const Registered<Physics>> registry) {
  for (const auto& entry : registry) {
    EXPECT_FALSE(entry.declaration.meaning.empty());
    const auto values = sample_values(entry.declaration);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Parameter& p = entry.declaration.parameters[i];
      EXPECT_TRUE(p.range.contains(values[i])) << p.name;
      EXPECT_TRUE(std::isnan(p.absent) || p.range.contains(p.absent)) << p.name;
      EXPECT_FALSE(p.meaning.empty()) << p.name;
    }
    EXPECT_NE(entry.make(values), nullptr);
  }
}

TEST(Registries, DeclareUsableEffects) {
  expect_declared_well(rheologies());
  expect_declared_well(outlets());
  expect_declared_well(inflows());
}

TEST(Rheologies, ViscosityIsPositiveSmoothAndNeverGrows) {
  for (const auto& entry : rheologies()) {
    const auto values = sample_values(entry.declaration);
    const auto rheology = entry.make(values);
    double last = rheology->viscosity(0);
    EXPECT_TRUE(std::isfinite(last));
    for (double shear_rate = 1e-9; shear_rate < 1e6; shear_rate *= 1.5) {
      const double mu = rheology->viscosity(shear_rate);
      EXPECT_GT(mu, 0) << entry.declaration.name;
      EXPECT_LE(mu, last * (1 + 1e-14)) << entry.declaration.name << " at " << shear_rate;
      EXPECT_LT(last / mu, 1.5) << entry.declaration.name << " jumps at " << shear_rate;
      EXPECT_TRUE(!rheology->is_constant() || mu == last) << entry.declaration.name;
      last = mu;
    }
  }
}

TEST(Rheologies, AbsentValuesMakeThemNewtonian) {
  for (const auto& entry : rheologies()) {
    auto values = sample_values(entry.declaration);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (const Parameter& p = entry.declaration.parameters[i]; !std::isnan(p.absent)) values[i] = p.absent;
    const auto rheology = entry.make(values);
    for (double shear_rate : {0.0, 1e-3, 1.0, 1e4})
      EXPECT_EQ(rheology->viscosity(shear_rate), rheology->viscosity(1)) << entry.declaration.name;
  }
}

TEST(Rheologies, OneNumberLeadsFromNewtonianBloodToShearThinning) {
  FluidCase fluid;
  fluid.rheology = {"newtonian", {0.04}};
  const EffectsList list = list_effects(fluid, UnitSystem::cgs());
  ASSERT_EQ(list.possible.size(), 1U);
  const PossibleEffect& thinning = list.possible[0];
  EXPECT_EQ(thinning.type, "shear_thinning");
  EXPECT_EQ(thinning.path, "fluid.rheology");
  ASSERT_EQ(thinning.amplitudes.size(), 1U);
  EXPECT_EQ(thinning.amplitudes[0].name, "excess");
  EXPECT_TRUE(thinning.required.empty()) << "the viscosity is the model's";
  fluid.rheology = {"casson", {0.04, 0.1, 100}};
  EXPECT_TRUE(list_effects(fluid, UnitSystem::cgs()).possible.empty());
}

TEST(Rheologies, KnownValues) {
  const std::vector<double> carreau{0.0345, 0.56, 3.313, 0.3568, 2.0}, casson{0.0414, 0.038, 1e6},
      power{0.42, 0.61, 1e-6};
  const auto rheology = [](std::size_t i, std::span<const double> values) { return rheologies()[i].make(values); };
  // Cho and Kensey 1991 at 1/s: 0.0345 + 0.5255 (1 + 3.313^2)^(-0.3216)
  EXPECT_NEAR(rheology(1, carreau)->viscosity(1), 0.0345 + 0.5255 * std::pow(1 + 3.313 * 3.313, -0.3216), 1e-12);
  const double root = std::sqrt(0.0414) + std::sqrt(0.038 / 10);
  EXPECT_NEAR(rheology(2, casson)->viscosity(10), root * root, 1e-12);
  EXPECT_NEAR(rheology(3, power)->viscosity(100), 0.42 * std::pow(100, -0.39), 1e-12);
}

TEST(ShearThinning, LeadsFromNewtonianBloodToCarreauAndYasudas) {
  const auto rheology = [](std::size_t i, const std::vector<double>& values) { return rheologies()[i].make(values); };
  const auto none = rheology(4, {0.0345, 0}), blood = rheology(4, {0.0345, 0.56 / 0.0345 - 1}),
             carreau = rheology(1, {0.0345, 0.56, 1.902, 0.22, 1.25});
  EXPECT_TRUE(none->is_constant());
  EXPECT_EQ(none->viscosity(3), 0.0345);
  EXPECT_FALSE(blood->is_constant());
  for (const double shear_rate : {0.0, 0.1, 1.0, 10.0, 1000.0})
    EXPECT_NEAR(blood->viscosity(shear_rate), carreau->viscosity(shear_rate), 1e-13);
}

TEST(PrescribedFlow, AddsWhatTheCurveLacks) {
  const std::vector<double> absent{1, 0, 0, 0, 0, 0, 0}, values{1.1, 0.02, 5, 1, 2, 3, 4};
  EXPECT_EQ(inflows()[0].make(absent)->added(0.3, 0.8), 0);
  const auto inflow = inflows()[0].make(values);
  EXPECT_NEAR(inflow->added(0, 0.8), 5 + 1 + 3, 1e-12);
  EXPECT_NEAR(inflow->added(0.2, 0.8), 5 + 2 - 3, 1e-12) << "a quarter of the beat";
  EXPECT_NEAR(inflow->added(0.1, 0.8), 5 + (1 + 2) / std::sqrt(2.0) + 4, 1e-12);
  EXPECT_EQ(inflow->added(0.1, 0), 5) << "without a period";
}

/// What identification and diagnosis need: a scale for whatever can be switched off.
TEST(Registries, WhatCanBeAbsentHasAScale) {
  const auto check = [](const EffectDeclaration& declaration) {
    for (const Parameter& p : declaration.parameters) {
      if (std::isnan(p.absent) || std::isnan(p.prior_deviation)) continue;
      EXPECT_TRUE(p.scale > 0 || p.transform == Transform::linear) << declaration.name << "." << p.name;
    }
  };
  for (const auto& entry : rheologies()) check(entry.declaration);
  for (const auto& entry : outlets()) check(entry.declaration);
  for (const auto& entry : inflows()) check(entry.declaration);
}

TEST(Outlets, OneStepIsImplicitAndPassive) {
  constexpr double dt = 1e-3;
  for (const auto& entry : outlets()) {
    const auto outlet = entry.make(sample_values(entry.declaration));
    const double Z = outlet->impedance(dt);
    EXPECT_GE(Z, 0) << entry.declaration.name;
    EXPECT_TRUE(std::isfinite(Z));
    // With no stored pressure and nothing behind it, an outlet cannot give pressure of its own.
    EXPECT_EQ(outlet->known({dt, 0, 0}), 0) << entry.declaration.name;
    // Without storage nothing changes.
    EXPECT_TRUE(outlet->stores() || outlet->advanced({dt, 3, 1}, 7) == 3) << entry.declaration.name;
  }
}

TEST(Outlets, AbsentValuesLeaveAnOpenEnd) {
  for (const auto& entry : outlets()) {
    auto values = sample_values(entry.declaration);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (const Parameter& p = entry.declaration.parameters[i]; !std::isnan(p.absent)) values[i] = p.absent;
    const auto outlet = entry.make(values);
    EXPECT_EQ(outlet->impedance(1e-3), 0) << entry.declaration.name;
    EXPECT_EQ(outlet->known({1e-3, 5, 0}), 0) << entry.declaration.name;
  }
}

TEST(Windkessel, KeepsItsEquations) {
  const double R_p = 150, R_d = 1850, C = 1.5e-3, P_distal = -30;
  const std::vector<double> values{R_p, R_d, C, 12, P_distal};
  const auto windkessel = outlets()[0].make(values);
  const double dt = 2e-3, P0 = 40, Q = 70;
  EXPECT_EQ(windkessel->initial(), 12);
  const OutletInput input{dt, P0, 0};
  const double P = windkessel->advanced(input, Q);
  EXPECT_NEAR(C * (P - P0) / dt + (P - P_distal) / R_d, Q, 1e-12 * Q);
  EXPECT_NEAR(windkessel->known(input) + windkessel->impedance(dt) * Q, P + R_p * Q, 1e-12 * R_p * Q);
}

TEST(Windkessel, WithoutComplianceIsAResistance) {
  const std::vector<double> values{150, 1850, 0, 12, -30}, same{2000, -30};
  const auto windkessel = outlets()[0].make(values), resistance = outlets()[1].make(same);
  EXPECT_EQ(windkessel->impedance(1e-3), resistance->impedance(1e-3));
  EXPECT_EQ(windkessel->known({1e-3, 77, 4}), resistance->known({1e-3, 77, 4}));
}

}  // namespace
}  // namespace tether::fluid
