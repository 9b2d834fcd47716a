/// What velocities alone tell, with the real programs on a coarse configs/tube: `tether identify` and `tether diagnose`
/// of a run with more inflow and stickier blood, measured with noise in a plane across the tube.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "common/base/child_process.hpp"
#include "common/io/lumen_motion.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int steps = 24;
constexpr double step = 4e-3, noise = 1, inflow = 1.2, viscosity = 0.4;

constexpr const char* model = R"(base: {}/configs/tube/case.yaml
name: model
time: {{step: 4e-3, end: 0.096}}
mesh: {{swept: {{around: 12, along: 12}}}}
observations:
  velocities:
    pc_mr: {{file: plane.csv, components: along, direction: [0, 0, 1], noise: {{deviation: 1 cm/s}}, held_out: [3, 7]}}
)";

/// Points of a plane across the tube, 0.5 cm apart, as pixels of phase-contrast MR are.
std::vector<Vec3> plane() {
  std::vector<Vec3> points;
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k)
      if (std::hypot(i, k) <= 3.5) points.emplace_back(0.5 * i, 0.5 * k, 6.5);
  return points;
}

class Velocities : public testing::Test {
 protected:
  Velocities() {
    folder.file("model.yaml", fmt::format(model, TETHER_SOURCE));
    const fs::path truth =
        folder.file("truth.yaml", fmt::format("base: model.yaml\nname: truth\nfluid: {{inlets: {{inlet: {{scale: "
                                              "{}}}}}, rheology: {{viscosity: {}}}}}\n",
                                              inflow, viscosity));
    measure([](double, Eigen::Index) { return 0.0; });
    const ChildEnd end = tether("simulate", truth, "truth_out");
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    const BloodVelocity recorded(folder / "truth_out/blood.velocity");
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, noise);
    measure([&](double time, Eigen::Index i) { return recorded.vectors_at(time)(2, i) + normal(random); });
  }
  void measure(const std::function<double(double, Eigen::Index)>& velocity) const {
    std::string rows = "time [s], x [cm], y [cm], z [cm], v [cm/s]\n";
    const std::vector<Vec3> points = plane();
    for (int k = 2; k <= steps; k += 2)
      for (std::size_t i = 0; i < points.size(); ++i)
        rows += fmt::format("{}, {}, {}, {}, {:.9g}\n", k * step, points[i](0), points[i](1), points[i](2),
                            velocity(k * step, static_cast<Eigen::Index>(i)));
    folder.file("plane.csv", rows);
  }
  ChildEnd tether(const std::string& verb, const fs::path& file, const std::string& output) const {
    return capture({{TETHER_PROGRAM, verb, file.string(), "--output", folder / output}, {}});
  }

  TemporaryFolder folder;
};

TEST_F(Velocities, IdentifyInflowAndViscosity) {
  const fs::path file = folder.file("identify.yaml", R"(base: model.yaml
name: identify
identification:
  parameters:
    inflow: {of: [fluid.inlets.inlet.scale], mean: 1, deviation: 0.3}
    viscosity: {of: [fluid.rheology.viscosity], transform: log, mean: 0.15, deviation: 1}
)");
  const ChildEnd end = tether("identify", file, "found");
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const Json found = Json::parse(content_of(folder / "found/estimate.json"));
  const double truths[] = {inflow, std::log(viscosity)};
  ASSERT_EQ(found["parameters"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& p = found["parameters"][i];
    const double deviation = p["estimate"]["theta_deviation"];
    std::printf("%s: %g, deviation %g of %g before, truth %g\n", p["name"].get<std::string>().c_str(),
                p["estimate"]["theta"].get<double>(), deviation, p["prior"]["theta_deviation"].get<double>(),
                truths[i]);
    EXPECT_LT(deviation, 0.5 * p["prior"]["theta_deviation"].get<double>()) << p;
    EXPECT_LT(std::abs(p["estimate"]["theta"].get<double>() - truths[i]), 2 * deviation) << p;
  }
}

TEST_F(Velocities, DiagnoseTheInflow) {
  const fs::path file = folder.file("diagnose.yaml", fmt::format(R"(base: model.yaml
name: diagnose
fluid: {{rheology: {{viscosity: {}}}}}
diagnosis:
  candidates: [tissue_mass]
  numerics: false
  exclude: [vicinity_left, vicinity_right, fluid.density, fluid.inlets.inlet.shift, fluid.inlets.inlet.offset,
            fluid.inlets.inlet.cosine_1, fluid.inlets.inlet.sine_1, fluid.inlets.inlet.cosine_2, fluid.inlets.inlet.sine_2]
)",
                                                                 viscosity));
  const ChildEnd end = tether("diagnose", file, "diagnosed");
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const Json found = Json::parse(content_of(folder / "diagnosed/diagnosis.json"));
  const Json first = found["effects"][0];
  EXPECT_EQ(first["name"], "fluid.inlets.inlet.scale") << end.output;
  EXPECT_TRUE(first["accepted"]) << end.output;
  EXPECT_LT(first["amplitude"]["lower"], inflow);
  EXPECT_GT(first["amplitude"]["upper"], inflow);
  EXPECT_GT(first["held_out_gain"]["lower"], 0);
}

}  // namespace
}  // namespace tether
