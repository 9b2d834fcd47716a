// Measured pressures, flows and velocities as people have them, and how far a model is from them.
#include "observation_manager/measurements/flow_observations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Flow : public ::testing::Test {
 protected:
  FlowObservations load(const std::string& observations) {
    folder.file("case.yaml", "name: tube\nunits: cgs\ntime: {step: 1e-2, end: 0.8}\nobservations:\n" + observations);
    CaseFile file(folder / "case.yaml");
    ObservationsCase given;
    file.read("observations", given);
    file.finish();
    return load_flow_observations(given, file);
  }
  std::string message(const std::string& observations) {
    try {
      load(observations);
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string path = folder.path().string() + "/";
      for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
      return text;
    }
    return "no error";
  }
  /// Two points at three times; the second point is missing in the second frame.
  void write_plane() {
    folder.file("plane.csv",
                "time [ms], x [mm], y [mm], z [mm], v [m/s]\n"
                "0, 1, 0, 20, 0.1\n0, 3, 0, 20, 0.2\n200, 1, 0, 20, 0.3\n400, 3, 0, 20, 0.6\n400, 1, 0, 20, 0.5\n");
  }
  static constexpr const char* plane =
      "  velocities: {pc_mr: {file: plane.csv, components: along, direction: [0, 0, -2], noise: {deviation: 5 cm/s}";

  TemporaryFolder folder;
};

TEST_F(Flow, ReadsVelocitiesAtPointsInTheCasesUnits) {
  write_plane();
  const FlowObservations data = load(std::string(plane) + "}}\n");
  ASSERT_EQ(data.velocities.size(), 1U);
  const VelocitySeries& series = data.velocities[0];
  EXPECT_LT((data.points() - Points{{0.1, 0.3}, {0, 0}, {2, 2}}).norm(), 1e-14);
  ASSERT_EQ(series.frames().size(), 3U);
  EXPECT_NEAR(series.frames()[2].values(0, 1), 60, 1e-12);
  EXPECT_TRUE(std::isnan(series.frames()[1].values(0, 1)));
  EXPECT_NEAR((*series.measured(0.1))(0, 0), 20, 1e-12);
  EXPECT_TRUE(std::isnan((*series.measured(0.1))(0, 1))) << "not measured in one of the frames";
  EXPECT_FALSE(series.measured(0.42).has_value());
  EXPECT_EQ(series.components(Points{{1, 0}, {2, 0}, {3, -4}}), (Components{{-3, 4}}));
}

TEST_F(Flow, HasAlwaysTheSameRowsAndNoneWhereNothingIsSeen) {
  write_plane();
  folder.file("p.csv", "t [s], p [dyn/cm2]\n0.1, 100\n0.3, 300\n");
  const FlowObservations data = load(
      "  traces: {a: {observable: fluid.outlet.pressure, quantity: pressure, noise: {deviation: 7}, curve: {file: "
      "p.csv, "
      "time: t, value: p}}}\n" +
      std::string(plane) + ", held_out: [2]}}\n");
  const std::vector<const Measurement*> all = data.all();
  ASSERT_EQ(all.size(), 2U);
  const ModelMoment model{
      {"time", "fluid.outlet.pressure"}, {9, 150}, data.points(), Points{{0, nan}, {0, nan}, {-18, nan}}, {}};
  EXPECT_NEAR(all[0]->see(model, 0.2).at(0).difference, 50, 1e-12);
  const auto expect = [&](double time, double difference, double weight) {
    const std::vector<SeenRow> rows = all[1]->see(model, time);
    ASSERT_EQ(rows.size(), 2U) << time;
    EXPECT_NEAR(rows[0].difference, difference, 1e-12) << time;
    EXPECT_EQ(rows[0].weight, weight) << time;
    EXPECT_EQ(rows[1].weight, 0) << "outside the lumen, or not measured";
  };
  expect(0, 10 - 18, 1);
  expect(0.2, 30 - 18, 1);
  expect(0.3, 0, 0);  // the last frame is held out
}

TEST_F(Flow, NeedsTheColumnThatATraceNames) {
  folder.file("p.csv", "time [s], value [ml/s]\n0, 1\n1, 2\n");
  const FlowObservations data =
      load("  traces: {cuff: {observable: fluid.exit.flow, quantity: flow, curve: {file: p.csv}}}\n");
  const ModelMoment model{{"time", "fluid.outlet.flow"}, {0, 1}, Points(3, 0), Points(3, 0), {}};
  EXPECT_EQ(message_of([&] { data.traces[0].see(model, 0.5); }),
            "the model has no observable fluid.exit.flow; it has: time, fluid.outlet.flow");
}

TEST_F(Flow, BadTracesAreNamed) {
  const auto of = [&](const std::string& table, const std::string& more = "") {
    folder.file("p.csv", table);
    return message("  traces: {cuff: {observable: fluid.outlet.pressure, quantity: pressure, curve: {file: p.csv}" +
                   more + "}}\n");
  };
  const std::string rows = "0, 80\n0.5, 120\n";
  EXPECT_EQ(of("time [s], value [mmHg]\n" + rows), "no error");
  EXPECT_EQ(of("time [s], value\n" + rows),
            "p.csv:2: the unit of value must stand in its heading, as in value [g/(cm s2)]");
  EXPECT_EQ(of("time, value [mmHg]\n" + rows), "p.csv:2: the unit of time must stand in its heading, as in time [ms]");
  EXPECT_EQ(of("time [s], value [ml/s]\n" + rows),
            "p.csv:2: column 'value': '1 ml/s': ml/s is no unit of this field, which is in g/(cm s2)");
  EXPECT_EQ(message("  traces: {cuff: {observable: fluid.outlet.flow, quantity: pressure, curve: {file: p.csv}}}\n"),
            "case.yaml:5: observations.traces.cuff.quantity: pressure, but fluid.outlet.flow is a flow");
  EXPECT_EQ(of("time [s], value [mmHg]\n" + rows, ", time_shift: 3"),
            "case.yaml:5: observations.traces.cuff: its times are from 3 to 3.5, the run is from 0 to 0.8: period or "
            "time_shift?");
}

TEST_F(Flow, TimesOfABeatHaveNoUnit) {
  folder.file("plane.csv", "time [ms], x [cm], y [cm], z [cm], v [cm/s]\n0, 0, 0, 1, 5\n400, 0, 0, 1, 6\n");
  EXPECT_EQ(
      message(std::string(plane) + ", beat: 0.8}}\n"),
      "plane.csv:2: time is in ms, but with beat in the case times are fractions of a beat: give period instead of "
      "beat, or leave out the unit");
  folder.file("plane.csv", "time, x [cm], y [cm], z [cm], v [cm/s]\n0, 0, 0, 1, 5\n0.5, 0, 0, 1, 6\n");
  EXPECT_EQ(load(std::string(plane) + ", beat: 0.8}}\n").velocities[0].frames()[1].time, 0.4);
  EXPECT_EQ(message(std::string(plane) + "}}\n"),
            "plane.csv:2: the unit of time must stand in its heading, as in time [ms]");
}

TEST_F(Flow, BadVelocitiesAreNamedWithTheirPlace) {
  const auto of = [&](const std::string& table, const std::string& more = "") {
    folder.file("plane.csv", "time [s], x [cm], y [cm], z [cm], v [cm/s]\n" + table);
    return message(std::string(plane) + more + "}}\n");
  };
  const std::string good = "0, 0, 0, 1, 5\n0.1, 0, 0, 1, 6\n";
  EXPECT_EQ(of(good), "no error");
  EXPECT_EQ(of(good + "0, 0, 0, 2, 7\n"),
            "plane.csv:4: the time 0 comes after 0.1: the rows of a frame must stand together, in order");
  EXPECT_EQ(of("0, 0, 0, 1, 1e160\n"), "plane.csv:2: v: 1e160: must be from -1e+20 to 1e+20");
  EXPECT_EQ(of(good + "0.1, 0, 0, 1, 7\n"), "plane.csv:4: the point has a velocity at 0.1 already");
  std::string moving;
  for (int i = 0; i < 5000; ++i) moving += fmt::format("{:.4f}, {:.4f}, 0, 1, 5\n", 1e-4 * i, 1e-4 * i);
  EXPECT_EQ(of(moving),
            "plane.csv:5001: has 5000 times and 5000 different points: all points at all times would be more than "
            "20000000 numbers");
  EXPECT_EQ(of(good, ", held_out: [2]"),
            "case.yaml:5: observations.velocities.pc_mr.held_out: there is no frame 2; frames are numbered 0 to 1");
  EXPECT_EQ(
      of(good, ", held_out: [0, 1]"),
      "case.yaml:5: observations.velocities.pc_mr.held_out: all 2 frames: one at least must be left to the model");
  EXPECT_EQ(of(good, ", period: 0.1"),
            "case.yaml:5: observations.velocities.pc_mr: its frames are from 0 to 0.1, beyond one period of 0.1");
  EXPECT_EQ(
      of(good, ", time_shift: 5"),
      "case.yaml:5: observations.velocities.pc_mr: its frames are from 5 to 5.1, the run is from 0 to 0.8: period "
      "or time_shift?");
  folder.file("plane.csv", "time [s], x, y [cm], z [cm], v [cm/s]\n" + good);
  EXPECT_EQ(message(std::string(plane) + "}}\n"), "plane.csv:2: the unit of x must stand in its heading, as in x [cm]");
}

}  // namespace
}  // namespace tether::testing
