#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"

/// Coupled vessels whose end rings are not clamped, on a coarse configs/tube: they stay as quiet as the clamped one.
namespace tether {
namespace {

struct Inlet {
  const char *name, *ring, *flow_through = "plane";
};

class Rings : public ::testing::TestWithParam<Inlet> {
 protected:
  std::filesystem::path tube() const {
    const auto file = case_variant(
        TETHER_SOURCE "/configs/tube/case.yaml", folder / "case",
        {{"around: 24", "around: 12"},
         {"along: 20", "along: 12"},
         {"inlet_ring: {type: clamped}", std::string("inlet_ring: ") + GetParam().ring},
         {"profile: parabolic", "profile: parabolic\n      flow_through: " + std::string(GetParam().flow_through)}});
    std::ofstream motion(folder / "case/heart.csv");
    motion << "time [s], x [cm], y [cm], z [cm]\n";
    for (int k = 0; k < 80; ++k)
      motion << fmt::format("{}, 0, 0, {}\n", 0.01 * k, -0.3 * std::pow(std::sin(std::numbers::pi * k / 80), 2));
    return file;
  }
  TemporaryFolder folder;
};

/// An odd-even ringing in time, as of an explicit added mass, would grow in the fourth difference.
TEST_P(Rings, StayQuiet) {
  CoupledVessel vessel(tube());
  std::vector<double> pressure;
  double mass = 0;
  for (int step = 0; step < 180; ++step) {
    vessel.advance();
    pressure.push_back(vessel.of_fluid("inlet.pressure") / 1333.22);
    mass = std::max(mass, std::abs(vessel.of_fluid("mass_balance_error")));
  }
  double ringing = 0;
  for (std::size_t k = 40; k + 2 < pressure.size(); ++k)
    ringing = std::max(
        ringing,
        std::abs(pressure[k - 2] - 4 * pressure[k - 1] + 6 * pressure[k] - 4 * pressure[k + 1] + pressure[k + 2]) / 16);
  EXPECT_LT(ringing, 0.15) << "mmHg";
  EXPECT_LT(mass, 1e-9);
}

constexpr const char* heart = "{type: driven, motion: {file: heart.csv, period: 0.8, harmonics: 2}}";

INSTANTIATE_TEST_SUITE_P(
    Inlet, Rings,
    ::testing::Values(Inlet{"clamped", "{type: clamped}"}, Inlet{"free", "{type: free}"},
                      Inlet{"held", "{type: visco_elastic, stiffness: 1e5}"},
                      Inlet{"moved", "{type: visco_elastic, stiffness: 1e7, motion: {file: heart.csv, period: 0.8}}"},
                      Inlet{"driven", heart}, Inlet{"driven_with_the_flow", heart, "ring"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace tether
