#include "diagnosis/explanation/force_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tether {
namespace {

/// Two harmonics of a beat of 0.8 s, 0.2 cm large.
class ForceLawTest : public ::testing::Test {
 protected:
  ForceLawTest() {
    const double w = 2 * std::numbers::pi / 0.8;
    for (VectorXd* series : {&motion.displacement, &motion.velocity, &motion.acceleration, &motion.pressure})
      series->resize(moments);
    for (Eigen::Index i = 0; i < moments; ++i) {
      const double t = 0.8 * static_cast<double>(i) / moments;
      motion.displacement(i) = 0.2 * std::sin(w * t) + 0.05 * std::cos(2 * w * t);
      motion.velocity(i) = 0.2 * w * std::cos(w * t) - 0.1 * w * std::sin(2 * w * t);
      motion.acceleration(i) = -0.2 * w * w * std::sin(w * t) - 0.2 * w * w * std::cos(2 * w * t);
      motion.pressure(i) = 4e4 * std::exp(-3 * t);
    }
  }
  VectorXd noise(double deviation) {
    std::normal_distribution<double> normal(0, deviation);
    VectorXd all(moments);
    for (double& value : all) value = normal(generator);
    return all;
  }
  ForceLaw law(const VectorXd& force, double correlated = 1) const {
    return law_of(force, VectorXd::Ones(moments), motion, correlated);
  }
  static constexpr Eigen::Index moments = 80;
  LocalMotion motion;
  std::mt19937_64 generator{2};
};

TEST_F(ForceLawTest, FindsASpringAndADamperAndHowSureTheyAre) {
  int right = 0, inside = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const ForceLaw found = law(-1e5 * motion.displacement - 2e3 * motion.velocity + noise(500));
    if (found.text.find("un") == std::string::npos || found.terms.size() != 2) continue;
    ++right;
    EXPECT_GT(found.explained, 0.99);
    EXPECT_TRUE(found.is_expression);
    for (const LawTerm& term : found.terms)
      inside += std::abs(term.coefficient - (term.name == "un" ? -1e5 : -2e3)) < 1.96 * term.deviation ? 1 : 0;
  }
  EXPECT_GE(right, 95);
  EXPECT_NEAR(inside, 0.95 * 2 * right, 10);
}

TEST_F(ForceLawTest, TellsACubicFromALinearSpring) {
  const VectorXd cube = motion.displacement.array().cube();
  const ForceLaw found = law(-3e6 * cube + noise(200));
  ASSERT_EQ(found.terms.size(), 1U) << found.text;
  EXPECT_EQ(found.terms[0].name, "un^3");
  EXPECT_NEAR(found.terms[0].coefficient, -3e6, 3 * found.terms[0].deviation);
}

TEST_F(ForceLawTest, APressureIsNoFormulaOfTheWall) {
  const ForceLaw found = law(-0.3 * motion.pressure + noise(100));
  ASSERT_EQ(found.terms.size(), 1U) << found.text;
  EXPECT_EQ(found.terms[0].name, "pressure");
  EXPECT_FALSE(found.is_expression);
}

TEST_F(ForceLawTest, WithoutNoiseTheCoefficientsAreExact) {
  const ForceLaw found = law(-7e4 * motion.displacement);
  EXPECT_EQ(found.text, "-7e+04*un");
  EXPECT_NEAR(found.terms[0].coefficient, -7e4, 1e-6);
  EXPECT_NEAR(found.explained, 1, 1e-12);
}

TEST_F(ForceLawTest, NoiseHasNoLaw) {
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) found += law(noise(1000)).terms.empty() ? 0 : 1;
  EXPECT_LE(found, 5);
}

TEST_F(ForceLawTest, FewIndependentMomentsAreCautious) {
  const VectorXd force = -1e5 * motion.displacement + noise(2e4);
  EXPECT_GE(law(force).terms.size(), 1U);
  EXPECT_TRUE(law(force, 20).terms.empty()) << "four independent moments show no law";
}

TEST_F(ForceLawTest, SaysWhichTermsCannotBeToldApart) {
  motion.pressure = 3e5 * motion.displacement + noise(300);  // a vessel that only fills
  const ForceLaw found = law(-1e5 * motion.displacement + noise(2000));
  ASSERT_EQ(found.terms.size(), 1U) << found.text;
  const std::string other = found.terms[0].name == "un" ? "pressure" : "un";
  EXPECT_EQ(found.terms[0].alike, std::vector<std::string>{other});
}

}  // namespace
}  // namespace tether
