#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"

/// Both ways of coupling on a coarse configs/tube (312 nodes of wall) with its measured inflow; what a step conserves.
namespace tether {
namespace {

class CouplingMethods : public ::testing::Test {
 protected:
  std::filesystem::path coarse_tube(const std::string& method, const std::string& step = "2e-3") const {
    return case_variant(TETHER_SOURCE "/configs/tube/case.yaml", folder / method,
                        {{"around: 24", "around: 12"},
                         {"along: 20", "along: 12"},
                         {"step: 2e-3", "step: " + step},
                         {"coupling: {", "coupling: {method: " + method + ", "}});
  }
  TemporaryFolder folder;
};

TEST_F(CouplingMethods, EndOnTheSameStep) {
  CoupledVessel newton(coarse_tube("newton_krylov")), iqn(coarse_tube("iqn_ils"));
  for (int step = 1; step <= 60; ++step) {
    iqn.stand_where(newton);
    newton.advance();
    iqn.advance();
    const VectorXd V = newton.velocity();
    ASSERT_LE((iqn.velocity() - V).norm(), 10 * newton.tolerance() * V.norm()) << "step " << step;
  }
}

TEST_F(CouplingMethods, TakeFewEvaluations) {
  CoupledVessel newton(coarse_tube("newton_krylov")), iqn(coarse_tube("iqn_ils"));
  ASSERT_EQ(newton.tolerance(), 1e-6);
  const auto newton_effort = newton.advance(newton.steps_of_case());
  const auto iqn_effort = iqn.advance(150);  // systole
  std::printf("| newton_krylov | %.2f evaluations, %.1f Krylov iterations |\n| iqn_ils | %.2f evaluations |\n",
              newton_effort.evaluations, newton_effort.krylov_iterations, iqn_effort.evaluations);
  EXPECT_LE(newton_effort.evaluations, 2.5);
  EXPECT_LE(newton_effort.krylov_iterations, 10);
  EXPECT_LE(iqn_effort.evaluations, 4.5);
}

struct Balances {
  double inflow = 0, mass = 0, volume = 0;  ///< largest in magnitude
};

Balances balances(const std::filesystem::path& case_file, double end) {
  CoupledVessel tube(case_file);
  Balances largest;
  const auto note = [](double& most, double value) { most = std::max(most, std::abs(value)); };
  while (tube.time() < end - tube.dt() / 2) {
    tube.advance();
    note(largest.inflow, tube.of_fluid("inlet.flow"));
    note(largest.mass, tube.of_fluid("mass_balance_error"));
    note(largest.volume, tube.of_fluid("volume_balance_error"));
  }
  return largest;
}

TEST_F(CouplingMethods, KeepMassToRoundOffAndVolumeToSecondOrder) {
  const Balances coarse = balances(coarse_tube("newton_krylov"), 0.2),
                 fine = balances(coarse_tube("newton_krylov", "1e-3"), 0.2);
  const double order = std::log2(coarse.volume / fine.volume);
  std::printf("| flow in - flow out - change of volume, dt 2 and 1 ms, of %.0f cm3/s | %.2g | %.2g | %.2f | 2 |\n",
              fine.inflow, coarse.volume, fine.volume, order);
  std::printf("| mass in a step | %.1e | %.1e |\n", coarse.mass, fine.mass);
  for (const Balances& run : {coarse, fine}) EXPECT_LE(run.mass, 1e-10 * run.inflow);
  EXPECT_LE(coarse.volume, 1e-8 * coarse.inflow);
  EXPECT_GE(order, 1.8);
}

}  // namespace
}  // namespace tether
