// The real observation_manager, spawned by a master, on the measured slices of the descending aorta.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "common/base/child_process.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/protocol/run_job.hpp"

namespace tether {
namespace {

const std::string case_file = "configs/descending_aorta/case.yaml";

struct Vessel : ObservedCase {
  Vessel() : ObservedCase(case_file), surface(lumen()), data(load_observations(observations, surface, file)) {}
  LumenSurface surface;
  Observations data;
};

tests::JobResult ask(const std::vector<std::string>& words, const std::string& file = case_file) {
  std::vector<std::string> command{tests::test_program("ask_observation"),
                                   tests::product_program("observation_manager"), file};
  command.insert(command.end(), words.begin(), words.end());
  return tests::run_job(command);
}

TEST(ObservationManager, AnswersWhatTheLibrarySays) {
  const Vessel vessel;
  const tests::JobResult job = ask({"0.2"});
  ASSERT_EQ(job.exit_code, 0) << job.errors;
  EXPECT_TRUE(job.orphans.empty());
  std::istringstream lines(job.output);
  std::string first;
  std::getline(lines, first);
  EXPECT_EQ(first, "Tether observation_manager");
  const std::vector<Sample> samples = vessel.data.observe(vessel.surface.points, 0.2);
  ASSERT_EQ(samples.size(), 3U * 64);
  for (const Sample& sample : samples) {
    double distance = 0, weight = 0;
    int exclusion = 0;
    lines >> distance >> weight >> exclusion;
    EXPECT_EQ(distance, sample.distance);
    EXPECT_EQ(weight, sample.weight);
    EXPECT_EQ(exclusion, static_cast<int>(sample.excluded));
  }
}

TEST(ObservationManager, NeedsSomethingToCompareWith) {
  const tests::JobResult job = ask({"0.2"}, "configs/tube/case.yaml");
  EXPECT_EQ(job.exit_code, 2);
  EXPECT_EQ(
      job.errors,
      "ask_observation: solid_observation: configs/tube/case.yaml:1: observations: names no surfaces or contours to "
      "compare the lumen with\n");
}

TEST(ObservationManager, RefusesAnotherLumen) {
  const tests::JobResult job = ask({"0.2", "5"});
  EXPECT_EQ(job.exit_code, 1);
  EXPECT_NE(job.errors.find("the lumen has 15 numbers; its "), std::string::npos) << job.errors;
}

/// Root mean square of the distances at a time [mm].
double root_mean_square(const Vessel& vessel, double time) {
  const std::vector<Sample> samples = vessel.data.observe(vessel.surface.points, time);
  double weight = 0;
  for (const Sample& s : samples) weight += s.weight;
  EXPECT_EQ(count_exclusions(samples)[0], static_cast<int>(samples.size()));
  return 10 * std::sqrt(misfit(samples) / weight);
}

TEST(DescendingAorta, LiesOnItsEndDiastolicContoursAndFillsByAMillimetre) {
  const Vessel vessel;
  const double rest = root_mean_square(vessel, 0.010);
  EXPECT_LT(rest, 0.1);
  const double peak = root_mean_square(vessel, 0.24);
  std::printf("| model at rest against the measured slices, rms at 10 ms and 240 ms [mm] | %.3f %.3f |\n", rest, peak);
  EXPECT_GT(peak, 1.0);
  EXPECT_LT(peak, 3.0);
  EXPECT_TRUE(vessel.data.notes().empty());
}

TEST(ObservationManager, ValidatesCasesWithAndWithoutMeasurements) {
  const std::string program = tests::product_program("observation_manager");
  const ChildEnd good = capture({{program, "--validate", case_file}, {}});
  EXPECT_EQ(good.exit_code, 0) << good.errors;
  const TemporaryFolder folder;
  folder.file("p.csv", "time [s], value [mmHg]\n0, 100\n1, 120\n");
  const auto traced = [&](const std::string& observable) {
    const auto file = folder.file(
        "case.yaml",
        "name: blood\nunits: cgs\ntime: {step: 1e-2, end: 1}\nmesh: {source: swept, swept: {radius: 1, length: 3, "
        "wall_thickness: 0.1, around: 12, along: 6}}\nobservations:\n  traces: {cuff: {observable: " +
            observable + ", quantity: pressure, curve: {file: p.csv}}}\n");
    return capture({{program, "--validate", file.string()}, {}});
  };
  EXPECT_EQ(traced("fluid.outlet.pressure").exit_code, 0) << traced("fluid.outlet.pressure").errors;
  const ChildEnd unknown = traced("fluid.exit.pressure");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(
      unknown.errors.find("case.yaml:6: observations.traces.cuff.observable: fluid.exit.pressure: the vessel has no "
                          "opening, probe or section exit; its openings are inlet, outlet"),
      std::string::npos)
      << unknown.errors;
  const ChildEnd nothing = capture({{program, "--validate", "configs/tube/case.yaml"}, {}});
  EXPECT_EQ(nothing.exit_code, 0) << nothing.errors;
}

}  // namespace
}  // namespace tether
