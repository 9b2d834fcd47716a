/// `tether identify` with the real programs on a coarse configs/tube, from surfaces made by a run whose supports are
/// others.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <future>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <thread>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/io/lumen_motion.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "tests/faults/fault.hpp"
#include "tests/io/mpirun.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/processes.hpp"
#include "tests/scenarios/surface_file.hpp"
#include "tests/scenarios/valid_results.hpp"

namespace tether {
namespace identify_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int steps = 24;
constexpr double step = 4e-3, spine = 1e6, opposite = 1e4;

constexpr const char* section = R"(observations:
  surfaces:
    twin: {file: frames.csv, unit: cm, noise: {deviation: 0.005, correlation_length: 0.5}}
identification:
  parameters:
    spine: {of: [solid.support.regions.spine.stiffness], transform: log2, mean: 2e5, deviation: 2}
    opposite: {of: [solid.support.regions.opposite.stiffness], transform: log2, mean: 5e4, deviation: 2}
output:)";

Edits coarse(Edits edits) {
  edits.insert(edits.end(), {{"around: 24", "around: 12"},
                             {"along: 20", "along: 12"},
                             {"step: 2e-3", "step: 4e-3"},
                             {"checkpoint_every: 100", "checkpoint_every: 5"}});
  return edits;
}

/// All tests share the run that the data are of, and one identification from them.
class Identify : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const fs::path truth = case_variant(source, folder / "truth", coarse({}));
    ASSERT_EQ(tether("simulate", truth, "truth_out", {}).exit_code, 0);
    case_file = case_variant(source, folder / "case", coarse({{"output:", section}}));
    write_surfaces(truth);
    const ChildEnd end = tether("identify", case_file, "one", {"--processes", "2"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
  }
  static void TearDownTestSuite() {
    expect_valid_results(folder);
    fs::remove_all(folder);
  }
  static void write_surfaces(const fs::path& truth) {
    const ObservedCase model(truth);
    const LumenSurface lumen = model.lumen();
    const LumenMotion motion(folder / "truth_out/lumen.motion");
    std::ofstream list(folder / "case/frames.csv");
    list << "file, time [s]\n";
    for (int k = 0; k <= steps; k += 2) {
      const std::string name = fmt::format("lumen_{}.stl", k);
      write_stl(folder / "case" / name, motion.at(k * step), lumen.triangles);
      list << fmt::format("{}, {}\n", name, k * step);
    }
  }
  static ChildEnd tether(const std::string& verb, const fs::path& file, const std::string& output,
                         const std::vector<std::string>& options, int number = steps,
                         std::vector<std::pair<std::string, std::string>> environment = {}) {
    std::vector<std::string> words{TETHER_PROGRAM,  verb,      file.string(),          "--output",
                                   folder / output, "--steps", std::to_string(number), "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return capture({words, std::move(environment)});
  }
  static Json estimate(const std::string& output) { return Json::parse(content_of(folder / output / "estimate.json")); }
  /// theta and deviation of each parameter.
  static std::vector<std::pair<double, double>> theta(const Json& estimate) {
    std::vector<std::pair<double, double>> all;
    for (const Json& p : estimate["parameters"])
      all.emplace_back(p["estimate"]["theta"], p["estimate"]["theta_deviation"]);
    return all;
  }
  static void expect_same(const std::string& one, const std::string& other) {
    const auto a = theta(estimate(one)), b = theta(estimate(other));
    ASSERT_EQ(a.size(), 2U);
    ASSERT_EQ(b.size(), 2U);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].first, b[i].first, 1e-3 * a[i].second);  // the coupling is solved to 1e-6
      EXPECT_NEAR(a[i].second, b[i].second, 1e-3 * a[i].second);
    }
  }
  static constexpr const char* source = TETHER_SOURCE "/configs/tube/case.yaml";
  static inline const fs::path folder = fs::temp_directory_path() / fmt::format("tether_identify_{}", getpid());
  static inline fs::path case_file;
};

TEST_F(Identify, FindsWhatTheDataWereMadeWith) {
  const Json found = estimate("one");
  ASSERT_EQ(found["parameters"].size(), 2U);
  const double truths[] = {spine, opposite};
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& p = found["parameters"][i];
    EXPECT_LT(p["estimate"]["theta_deviation"], 0.3 * p["prior"]["theta_deviation"].get<double>()) << p;
    EXPECT_LT(std::abs(std::log2(p["estimate"]["value"].get<double>() / truths[i])),
              2 * p["estimate"]["theta_deviation"].get<double>())
        << p;
    EXPECT_EQ(p["unit"], "g/(cm2 s2)");
  }
  const CsvTable table(folder / "one/estimate.csv");
  EXPECT_EQ(table.rows(), static_cast<std::size_t>(steps + 1));
  EXPECT_NEAR(table.numbers("spine").back(), found["parameters"][0]["estimate"]["value"].get<double>(), 1e-6 * spine);
  EXPECT_TRUE(fs::exists(folder / "one/plots/estimate.png"));

  const ChildEnd again = tether("simulate", folder / "one/identified.yaml", "identified", {});
  EXPECT_EQ(again.exit_code, 0) << again.errors;

  fs::copy(folder / "one", folder / "changed", fs::copy_options::recursive);
  std::ofstream(folder / "changed/identified.yaml", std::ios::app) << "# mine\n";
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--resume"}}) {
    const ChildEnd refused = tether("identify", case_file, "changed", more);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.errors.find("changed/identified.yaml: is not as tether identify made it"), std::string::npos)
        << refused.errors;
    EXPECT_TRUE(fs::exists(folder / "changed/estimate.json"));
  }

  ASSERT_EQ(tether("identify", case_file, "three", {"--processes", "3"}).exit_code, 0);
  EXPECT_EQ(estimate("three")["cost"]["groups"], 3);
  expect_same("one", "three");
}

/// An identification of two groups, all programs of the line given by the user.
ChildEnd on_a_line(const fs::path& case_file, const fs::path& of_observation, const fs::path& output, int steps) {
  const auto part = [](const char* program, const char* number, const fs::path& given) {
    return std::vector<std::string>{"-n", number, fs::path(TETHER_PROGRAM).parent_path() / program, given};
  };
  std::vector<std::string> words;
  for (const auto& more : {part("identification_master", "1", case_file),
                           {"--output", output, "--steps", std::to_string(steps), "--quiet", ":"},
                           part("fsi_master", "2", case_file),
                           {":"},
                           part("observation_manager", "2", of_observation)})
    words.insert(words.end(), more.begin(), more.end());
  return capture(on_mpirun(words));
}

TEST_F(Identify, OfAnMpirunLineAllHaveOneCase) {
  std::ofstream(folder / "other.yaml") << "base: " << case_file.string() << "\nfluid: {density: 1.2}\n";
  const ChildEnd end = on_a_line(case_file, folder / "other.yaml", folder / "mixed", steps);
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("a solid_observation of the mpirun line has another case than its fsi_master"),
            std::string::npos)
      << end.errors;
  EXPECT_FALSE(fs::exists(folder / "mixed"));
}

/// Where a cluster forbids that programs start others: groups have the codes that the line does not hold.
TEST_F(Identify, IsTheSameOnAnMpirunLine) {
  const ChildEnd end = on_a_line(case_file, case_file, folder / "line", steps);
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(content_of(folder / "line/estimate.csv"), content_of(folder / "one/estimate.csv"));
}

/// To the bit: with three particles on two groups of processes. The run waits where it saves its second state until a
/// process is killed.
TEST_F(Identify, KilledAndResumedItFindsTheSame) {
  for (const char* program : {"fsi_master", "observation_manager"}) {
    const std::string output = std::string("killed_") + program;
    fs::copy(folder / "one", folder / output, fs::copy_options::recursive);  // what a run before left
    fs::remove_all(folder / output / "checkpoint");
    const fs::path paused = folder / (output + "_paused");
    auto faults = with_fault("identification_master:rename:identification.previous:1:PAUSE", folder / output);
    faults.emplace_back("TETHER_FAULT_FLAG", paused.string());
    auto end = std::async(std::launch::async, [&] {
      return tether("identify", case_file, output, {"--processes", "2"}, steps, faults);
    });
    while (!fs::exists(paused) && end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) continue;
    ASSERT_TRUE(fs::exists(paused)) << end.get().errors;
    const pid_t process = process_of(program, case_file);
    if (process != 0) kill(process, SIGKILL);
    fs::remove(paused);
    ASSERT_NE(process, 0) << program;
    const ChildEnd ended = end.get();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_NE(ended.errors.find(fmt::format("{} (pid {}", program, process)), std::string::npos) << ended.errors;
    for (const char* old : {"estimate.json", "identified.yaml", "plots/estimate.png"})
      EXPECT_FALSE(fs::exists(folder / output / old)) << old << " of the run before";
    EXPECT_EQ(ended.errors.find("ended by signal"), std::string::npos) << "one message is enough: " << ended.errors;
    EXPECT_NE(ended.errors.find("--processes 2 --resume\n"), std::string::npos) << ended.errors;
    EXPECT_EQ(orphan_of({"observation_manager"}, {case_file}), "");
    ASSERT_EQ(tether("identify", case_file, output, {"--resume"}).exit_code, 0) << "on as many groups as before";
    for (const char* name : {"estimate.csv", "identified.yaml"})
      EXPECT_EQ(content_of(folder / "one" / name), content_of(folder / output / name)) << name;
  }
}

/// As a scheduler does before it ends a job.
TEST_F(Identify, ToldToEndItSavesItsStateAndGoesOnToTheSame) {
  auto end = std::async(std::launch::async, [&] {
    return tether("identify", case_file, "told", {"--processes", "2"});
  });
  while (process_of("observation_manager", case_file) == 0 &&
         end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
    continue;
  const pid_t front_end = process_of("tether", case_file);
  ASSERT_NE(front_end, 0);
  kill(front_end, SIGUSR1);
  const ChildEnd ended = end.get();
  EXPECT_EQ(ended.exit_code, 1);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(ended.errors, found,
                                std::regex("identification_master: told to save its state and end in step (\\d+)\n"
                                           "The state after (\\d+) steps")))
      << ended.errors;
  EXPECT_EQ(std::stoi(found[2]), std::stoi(found[1]) - 1) << ended.errors;
  ASSERT_EQ(tether("identify", case_file, "told", {"--resume", "--processes", "2"}).exit_code, 0);
  for (const char* name : {"estimate.csv", "identified.yaml"})
    EXPECT_EQ(content_of(folder / "one" / name), content_of(folder / "told" / name)) << name;
}

/// By somebody else, while groups of programs start.
TEST_F(Identify, TellsOfMeasurementsThatAreWrittenMeanwhile) {
  const fs::path file =
      case_variant(case_file, folder / "late", {{"coupling: {", "coupling: {programs: {solid: ./late.sh}, "}});
  std::ofstream(folder / "late/late.sh") << fmt::format("#!/bin/sh\necho >> {}/frames.csv\nexec {}/solid \"$@\"\n",
                                                        (folder / "late").string(),
                                                        fs::path(TETHER_PROGRAM).parent_path().string());
  fs::permissions(folder / "late/late.sh", fs::perms::owner_all);
  const ChildEnd ended = tether("identify", file, "late_out", {"--processes", "2"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.errors.find("frames.csv: was written during the run"), std::string::npos) << ended.errors;
  EXPECT_FALSE(fs::exists(folder / "late_out/estimate.json"));
}

/// From a checkpoint before the first frame that counts; neither with another step nor from other measurements.
TEST_F(Identify, ContinuesOnlyFromTheSameCaseAndMeasurements) {
  const Edits at_frames{{"identification:\n", "identification:\n  observe: frames\n"},
                        {"checkpoint_every: 5", "checkpoint_every: 1"}};
  const fs::path file = case_variant(case_file, folder / "frames", at_frames);
  const ChildEnd part =
      capture({{TETHER_PROGRAM, "identify", file.string(), "--output", folder / "part", "--steps", "1"}, {}});
  ASSERT_EQ(part.exit_code, 0) << part.errors;
  EXPECT_NE(part.output.find("No data were used"), std::string::npos) << part.output;
  EXPECT_EQ(part.output.find("misfit"), std::string::npos) << part.output;
  const Json nothing = estimate("part");
  EXPECT_EQ(nothing["innovations"]["effective_data"], 0);
  ASSERT_FALSE(nothing["notices"].empty());
  EXPECT_NE(nothing["notices"].back().get<std::string>().find("no step met any data"), std::string::npos);

  /// While the content of a file is another one.
  const auto expect_refused = [&](const fs::path& changed, const std::string& content) {
    const std::string before = content_of(changed);
    std::ofstream(changed, std::ios::binary) << content;
    const ChildEnd end = tether("identify", file, "part", {"--resume"}, 4);
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.errors.find("checkpoint of another case"), std::string::npos) << end.errors;
    std::ofstream(changed, std::ios::binary) << before;
  };
  const fs::path finer = case_variant(file, folder / "finer", {{"step: 4e-3", "step: 2e-3"}});
  expect_refused(file, content_of(finer));
  expect_refused(file.parent_path() / "lumen_2.stl", content_of(file.parent_path() / "lumen_4.stl"));

  ASSERT_EQ(tether("compare", file, "part", {}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "part/checkpoint/master.bin")) << "the run saves its states in the same place";
  ASSERT_EQ(tether("identify", file, "part", {"--resume"}, 4).exit_code, 0) << "which a comparison leaves";
  const Json found = estimate("part");
  EXPECT_GT(found["innovations"]["effective_data"], 0);
  EXPECT_GT(found["cost"]["cpu_seconds"], nothing["cost"]["cpu_seconds"]);
}

TEST_F(Identify, WithoutCorrectionsItWritesAllSensitivities) {
  const fs::path watching = case_variant(case_file, folder / "watching",
                                         {{"identification:",
                                           "identification:\n  observe: never\n  allowed: {model: 0, "
                                           "bias: 0, displacement: 0}"}});
  const ChildEnd end = tether("identify", watching, "watched", {});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const Json found = estimate("watched");
  EXPECT_FALSE(found["corrected"]);
  for (const Json& p : found["parameters"]) {
    EXPECT_NEAR(p["estimate"]["theta"], p["prior"]["theta"].get<double>(), 1e-12);
    EXPECT_LT(p["estimate"]["theta_deviation"], 0.5 * p["prior"]["theta_deviation"].get<double>());
  }
  EXPECT_FALSE(fs::exists(folder / "watched/identified.yaml"));
  const CsvTable table(folder / "watched/sensitivities.csv");
  const auto information = table.numbers("spine.information");
  EXPECT_NEAR(std::accumulate(information.begin(), information.end(), 0.0),
              found["identifiability"]["gramian"][0][0].get<double>(),
              1e-3 * found["identifiability"]["gramian"][0][0].get<double>());
  const auto regions = table.texts("region");
  for (const char* region : {"spine", "opposite"})
    EXPECT_NE(std::find(regions.begin(), regions.end(), region), regions.end());
  EXPECT_GT(CsvTable(folder / "watched/sensitivities_of_data.csv").rows(), 100U);
}

/// One number by its name, the other as a part of what was found before.
TEST_F(Identify, BeginsWhereAnotherOneEnded) {
  const fs::path again = case_variant(
      case_file, folder / "again",
      {{"identification:", "identification:\n  prior_from: ../one/estimate.json"},
       {"transform: log2, mean: 2e5, deviation: 2", "transform: log2"},
       {"opposite: {of: [solid.support.regions.opposite.stiffness], transform: log2, mean: 5e4, deviation: 2}",
        "front: {of: [solid.support.regions.opposite.stiffness], transform: log2, part_of: opposite, deviation: 1}"}});
  const ChildEnd end = tether("identify", again, "twice", {}, 2);
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const auto first = theta(estimate("one"));
  const Json second = estimate("twice");
  EXPECT_NEAR(second["parameters"][0]["prior"]["theta"], first[0].first, 1e-12);
  EXPECT_NEAR(second["parameters"][0]["prior"]["theta_deviation"], first[0].second, 1e-12);
  EXPECT_NEAR(second["parameters"][1]["prior"]["theta"], first[1].first, 1e-12);
  EXPECT_NEAR(second["parameters"][1]["prior"]["theta_deviation"], std::hypot(first[1].second, 1), 1e-12);
}

TEST_F(Identify, TellsBeforeItBeginsWhatItWouldTake) {
  const ChildEnd plan = tether("identify", case_file, "planned", {"--plan", "--processes", "2"}, 7);
  ASSERT_EQ(plan.exit_code, 0) << plan.errors;
  EXPECT_NE(plan.output.find("3 particles"), std::string::npos) << plan.output;
  EXPECT_NE(plan.output.find("2 models at once"), std::string::npos) << plan.output;
  EXPECT_NE(plan.output.find("7 steps of"), std::string::npos) << plan.output;
  EXPECT_FALSE(fs::exists(folder / "planned")) << "nothing has begun";
}

TEST_F(Identify, SaysWhichNumberItDoesNotKnow) {
  const fs::path wrong =
      case_variant(case_file, folder / "wrong", {{"regions.spine.stiffness]", "regions.spin.stiffness]"}});
  fs::create_directories(folder / "none");
  const std::string mark = fmt::format("# case_file: {}\n{}", wrong.string(), content_of(wrong));
  std::ofstream(folder / "none/case_as_run.yaml") << mark;
  std::ofstream(folder / "none/estimate.json") << "earlier";
  const ChildEnd end = tether("identify", wrong, "none", {});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(content_of(folder / "none/estimate.json"), "earlier") << "kept until the case is accepted";
  EXPECT_EQ(content_of(folder / "none/case_as_run.yaml"), mark);
  fs::remove_all(folder / "none");  // no results
  EXPECT_NE(end.errors.find("did you mean solid.support.regions.spine.stiffness?"), std::string::npos) << end.errors;
}

}  // namespace identify_test
}  // namespace tether
