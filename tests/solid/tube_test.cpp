#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solid/report.hpp"
#include "tests/solid/tube_errors.hpp"

// Linear tubes in plane strain: inflation against Lame, ovalisation against Michell.
namespace tether {
namespace tube_test {

constexpr double young = 4e6;

TEST(MichellReference, SatisfiesEquilibriumHookesLawAndTheBoundaryConditions) {
  const LinearTube tube{2, 2.2, young, 0.45};
  const MichellOvalisation exact(tube, 3.0);
  EXPECT_NEAR(exact.radial_stress(2), -3, 1e-9);
  EXPECT_NEAR(exact.shear_stress(2), 0, 1e-9);
  EXPECT_NEAR(exact.radial_stress(2.2), 0, 1e-9);
  EXPECT_NEAR(exact.shear_stress(2.2), 0, 1e-9);
  const double r = 2.07, mu = tube.shear(), lambda = 2 * mu * tube.poisson / (1 - 2 * tube.poisson);
  const auto by_r = [&](double (MichellOvalisation::*f)(double) const) {
    return derivative([&](double h) { return (exact.*f)(r + h); }, 1e-3);
  };
  const double rr = exact.radial_stress(r), tt = exact.hoop_stress(r), rt = exact.shear_stress(r);
  EXPECT_NEAR(by_r(&MichellOvalisation::radial_stress) + 2 * rt / r + (rr - tt) / r, 0, 1e-6);
  EXPECT_NEAR(by_r(&MichellOvalisation::shear_stress) - 2 * tt / r + 2 * rt / r, 0, 1e-6);
  const double ur = exact.radial_displacement(r), ut = exact.hoop_displacement(r);
  const double err = by_r(&MichellOvalisation::radial_displacement), ett = (2 * ut + ur) / r;
  EXPECT_NEAR(rr, lambda * (err + ett) + 2 * mu * err, 1e-5);
  EXPECT_NEAR(tt, lambda * (err + ett) + 2 * mu * ett, 1e-5);
  EXPECT_NEAR(rt, mu * (by_r(&MichellOvalisation::hoop_displacement) - ut / r - 2 * ur / r), 1e-5);
}

TEST(MichellReference, ApproachesTheThinRing) {
  for (const double thickness : {0.2, 0.02}) {
    const LinearTube tube{2 - thickness / 2, 2 + thickness / 2, young, 0.3};
    const double at_mid_surface = tube.a / 2;  // the pressure acts on the inner face
    EXPECT_NEAR(MichellOvalisation(tube, 1).radial_displacement(2) / (thin_ring_ovalisation(tube, 1) * at_mid_surface),
                1, 0.6 * thickness);
  }
}

class Tube : public ::testing::TestWithParam<double> {};

TEST_P(Tube, PrismsDoNotLockAtTheWorkingResolution) {
  for (const int layers : {1, 2, 4}) {
    const TubeErrors coarse = tube_errors({24, layers}, GetParam()), fine = tube_errors({48, layers}, GetParam());
    EXPECT_LT(std::abs(coarse.inflation), 0.015) << layers;
    EXPECT_LT(std::abs(coarse.ovalisation), 0.05) << layers;
    EXPECT_LT(std::abs(fine.inflation), 0.006) << layers;
    EXPECT_LT(std::abs(fine.ovalisation), 0.014) << layers;
  }
}

TEST_P(Tube, PrismsConvergeWithSecondOrder) {
  const std::array around{24, 48, 96};
  std::array<double, 3> inflation, ovalisation;
  for (std::size_t i = 0; i < 3; ++i) {
    const TubeErrors errors = tube_errors({around[i], around[i] / 12}, GetParam());
    inflation[i] = errors.inflation;
    ovalisation[i] = errors.ovalisation;
  }
  report(fmt::format("tube_inflation_{}", GetParam()), around, inflation);
  report(fmt::format("tube_ovalisation_{}", GetParam()), around, ovalisation);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::log2(inflation[i] / inflation[i + 1]), 2, 0.25);
    EXPECT_NEAR(std::log2(ovalisation[i] / ovalisation[i + 1]), 2, 0.25);
  }
}

/// Diagonals that all run one way, as an arbitrary triangulation may have them in places.
TEST_P(Tube, OneWayDiagonalsDoNotLockOneLayer) {
  const TubeMesh tube{24, 1};
  EXPECT_LT(std::abs(tube_errors(tube, with_one_way_diagonals(tube_slice(tube)), GetParam()).ovalisation), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Poisson, Tube, ::testing::Values(0.3, 0.45, 0.499),
                         [](const auto& info) { return fmt::format("{:.0f}", 1000 * info.param); });

}  // namespace tube_test
}  // namespace tether
