/// `tether twin`, `tether compare` and `tether score` with the real programs on a coarse configs/tube: a model without
/// the spine's support against data with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/io/lumen_motion.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/valid_results.hpp"

namespace tether {
namespace twin_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

ChildEnd tether(const std::vector<std::string>& words) {
  std::vector<std::string> line{TETHER_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  return capture({line, {}});
}

/// The model, and truths that build on it: itself, and one with the spine's support on the same mesh.
class Twin : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.file("model.yaml", fmt::format("base: {}/configs/tube/case.yaml\nname: model\n"
                                          "time: {{step: 4e-3, end: 0.08}}\nmesh: {{swept: {{around: 12, along: 8}}}}\n"
                                          "solid: {{support: {{regions: {{spine: {{stiffness: 0}}}}}}}}\n",
                                          TETHER_SOURCE));
    folder.file("same.yaml", "base: model.yaml\nname: same\n");
    folder.file("held.yaml", "base: model.yaml\nname: held\nsolid: {support: {regions: {spine: {stiffness: 1e6}}}}\n");
  }
  /// The case of a twin, made. `more`: further lines of the section.
  fs::path made(const std::string& truth, const std::string& more, const std::string& name = "twin") const {
    const fs::path file = folder.file(
        name + ".yaml",
        fmt::format("base: model.yaml\nname: {}\ntwin:\n  truth: {}.yaml\n  frames: 4\n{}", name, truth, more));
    const ChildEnd end = tether({"twin", file.string(), "--output", (folder / name).string()});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    said = end.output;
    return folder / name / "case.yaml";
  }
  Json compared(const fs::path& case_file) const {
    const ChildEnd end = tether({"compare", case_file.string(), "--output", results().string()});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    return Json::parse(content_of(results() / "comparison.json"));
  }
  void TearDown() override { expect_valid_results(folder.path()); }
  fs::path results() const { return folder / "out"; }
  static Json group(const Json& comparison, const Json& region) {
    for (const Json& g : comparison["sources"][0]["training"]["all_frames"])
      if (g["region"] == region && (g["series"].is_null())) return g;
    return {};
  }

  TemporaryFolder folder;
  mutable std::string said;
};

constexpr const char* exact = "  image: {voxel: [0, 0, 0]}\n";
constexpr const char* nothing = "  hidden: {verdict: nothing_missing}\n";
constexpr const char* spine =
    "  hidden: {effects: {visco_elastic: {where: spine, amplitude: 1e6, unit: g/(cm2 s2)}}}\n";

TEST_F(Twin, WithoutAHiddenEffectAgreesWithTheModel) {
  const Json comparison = compared(made("same", std::string(exact) + nothing + "  beat: 0.04\n  periodic: true\n"));
  const Json moments = comparison["sources"][0]["moments"];
  ASSERT_EQ(moments.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(moments[i]["time"], 0.05 + 0.01 * i, 1e-9) << "in the last beat";
  EXPECT_LT(group(comparison, nullptr)["linf"], 1e-6) << "cm: the nodes of the surface are those of the run";
  EXPECT_GT(group(comparison, nullptr)["apparent"]["linf"], 1e-3);
}

TEST_F(Twin, ShowsWhatTheHiddenEffectDoes) {
  const fs::path case_file = made("held", std::string(exact) + spine);
  const Json comparison = compared(case_file);
  const LumenMotion model(results() / "lumen.motion"), truth(case_file.parent_path() / "sealed/run/lumen.motion");
  double most = 0;
  for (const double time : {0.02, 0.04, 0.06, 0.08})
    most = std::max(most, (model.at(time) - truth.at(time)).colwise().norm().maxCoeff());
  EXPECT_GT(most, 1e-3);
  EXPECT_LT(group(comparison, "spine")["mean"], 0) << "the model moves too far outward";
  EXPECT_NEAR(group(comparison, nullptr)["linf"].get<double>() / most, 1, 0.05) << "motion is along the normal";
}

TEST_F(Twin, HasImagesNoiseTracesAndAnAnswer) {
  const std::string data =
      "  seed: 4\n  image: {voxel: [1 mm, 1 mm, 1 mm]}\n  noise: {deviation: 0.3 mm, correlation_length: 5 mm}\n  "
      "held_out: [1]\n"
      "  faults: {lost: [2]}\n"
      "  traces: {p: {observable: fluid.outlet.pressure, quantity: pressure, interval: 4 ms, noise: {deviation: 2 "
      "mmHg}}}\n";
  const fs::path case_file = made("held", data + spine), twin = case_file.parent_path();
  EXPECT_NE(said.find("3 surfaces, "), std::string::npos) << said;
  EXPECT_EQ(content_of(case_file).find("amplitude"), std::string::npos);
  const CsvTable times(twin / "data/lumen.csv");
  ASSERT_EQ(times.rows(), 3U);
  EXPECT_EQ(times.texts("file")[2], "lumen_03.vtp");
  EXPECT_NEAR(times.numbers("time")[2], 0.08, 1e-12);

  const Json comparison = compared(case_file), source = comparison["sources"][0];
  const double deviation = source["noise"]["deviation"];
  EXPECT_GT(deviation, 0.03) << "cm: the noise, and the image's own error";
  EXPECT_LT(deviation, 0.04);
  EXPECT_EQ(source["held_out"]["all_frames"].size(), 5U);
  const double l2 = group(comparison, "opposite")["in_noise"]["l2"];
  EXPECT_TRUE(l2 > 0.5 && l2 < 2) << l2;
  EXPECT_EQ(comparison["traces"][0]["values"], 16);
  EXPECT_NEAR(comparison["traces"][0]["in_noise"]["l2"].get<double>(), 1, 0.5);

  const std::string surface = content_of(twin / "data/lumen_03.vtp"), trace = content_of(twin / "data/p.csv");
  made("held", data + spine);
  EXPECT_NE(said.find("3 surfaces, "), std::string::npos);
  EXPECT_EQ(said.find("simulating"), std::string::npos) << "the run is there";
  EXPECT_TRUE(content_of(twin / "data/lumen_03.vtp") == surface) << "the same seed, the same bytes";
  EXPECT_EQ(content_of(twin / "data/p.csv"), trace);

  std::ofstream(results() / "diagnosis.json")
      << R"json({"verdict": "missing", "effects": [{"name": "visco_elastic", "where": "spine", "accepted": true,
             "amplitude": {"value": 1.1e6, "lower": 9e5, "upper": 1.3e6, "unit": "g/(cm2 s2)"}}]})json";
  const ChildEnd scored = tether({"score", twin.string(), "--output", results().string()});
  EXPECT_EQ(scored.exit_code, 0) << scored.errors;
  EXPECT_EQ(scored.output,
            "verdict: missing: right\n"
            "visco_elastic at spine: rank 1, accepted, amplitude +10.0 %, within its interval\n");
  EXPECT_TRUE(Json::parse(content_of(results() / "score.json"))["verdict_right"]);
  fs::remove(results() / "diagnosis.json");  // no file of ours: it says what a score reads, and no more
}

/// What the files of a folder hold.
std::map<fs::path, std::string> content_below(const fs::path& folder) {
  std::map<fs::path, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != ".lock") all[entry.path()] = content_of(entry.path());
  return all;
}

TEST_F(Twin, LeavesItsFolderAsItWasWhereItRefuses) {
  const fs::path twin = made("same", std::string(exact) + nothing).parent_path();
  fs::create_directories(twin / "data/notes");
  std::ofstream(twin / "data/notes/mine.csv") << "precious";
  const auto before = content_below(twin);
  const auto refused = [&](const std::string& name, const std::string& section, const char* option = "--quiet") {
    const fs::path file = folder.file(name + ".yaml", "base: model.yaml\nname: " + name + "\ntwin:\n" + section);
    const ChildEnd end = tether({"twin", file.string(), "--output", twin.string(), option});
    EXPECT_EQ(end.exit_code, 2) << section << end.errors;
    EXPECT_TRUE(content_below(twin) == before) << section << end.errors;
    return end.errors;
  };
  const std::string same = std::string("  truth: same.yaml\n  frames: 4\n") + exact + nothing;
  EXPECT_NE(refused("other", same).find("holds what tether twin made of " + (folder / "twin.yaml").string()),
            std::string::npos);
  EXPECT_NE(refused("other", same + "  first: 100\n", "--overwrite").find("frame 0 shows the time 100"),
            std::string::npos);
  EXPECT_NE(refused("twin", std::string("  truth: held.yaml\n") + nothing).find("holds the results of the case 'same'"),
            std::string::npos);
  folder.file("same.yaml", "base: model.yaml\nname: same\nfluid: {density: -1}\n");
  EXPECT_NE(refused("twin", same).find("density"), std::string::npos);

  folder.file("same.yaml", "base: model.yaml\nname: same\n");
  folder.file("other.yaml",
              "base: model.yaml\nname: other\ntwin:\n  truth: same.yaml\n  frames: 2\n" + std::string(exact) + nothing);
  const ChildEnd replaced =
      tether({"twin", (folder / "other.yaml").string(), "--output", twin.string(), "--overwrite"});
  EXPECT_EQ(replaced.exit_code, 0) << replaced.errors;
  EXPECT_FALSE(fs::exists(twin / "data/lumen_02.vtp"));
  EXPECT_EQ(content_of(twin / "data/notes/mine.csv"), "precious");
}

TEST_F(Twin, ReplacesNothingThatItDidNotMake) {
  const fs::path file =
      folder.file("twin.yaml", std::string("base: model.yaml\nname: twin\ntwin:\n  truth: same.yaml\n  frames: 2\n") +
                                   exact + nothing);
  for (const char* name : {"sealed", "data"}) fs::create_directories(folder / "mine" / name);
  std::ofstream(folder / "mine/data/precious.csv") << "precious";
  std::ofstream(folder / "mine/case.yaml") << "mine: 1";
  const auto mine = content_below(folder / "mine");
  const auto error_of = [&](const std::string& verb, const fs::path& of, const fs::path& output, const char* option) {
    const ChildEnd end = tether({verb, of.string(), "--output", output.string(), option});
    EXPECT_EQ(end.exit_code, 2) << end.errors;
    return end.errors;
  };
  EXPECT_NE(error_of("twin", file, folder / "mine", "--quiet").find("are not what tether twin made"),
            std::string::npos);
  EXPECT_EQ(error_of("twin", file, folder / "mine", "--overwrite"),
            (folder / "mine/case.yaml").string() +
                ": is not what tether twin made, and would be replaced; choose another folder with --output\n");
  EXPECT_NE(error_of("twin", file, folder.path(), "--overwrite").find(".yaml: is read, and"), std::string::npos);
  EXPECT_TRUE(content_below(folder / "mine") == mine);

  fs::remove(folder / "mine/case.yaml");
  const ChildEnd end = tether({"twin", file.string(), "--output", (folder / "mine").string(), "--overwrite"});
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(content_of(folder / "mine/data/precious.csv"), "precious");
  const fs::path outlets = fs::path(TETHER_SOURCE) / "configs/descending_aorta/outlets.yaml";
  EXPECT_NE(error_of("fit-outlets", outlets, folder / "mine", "--overwrite").find("case.yaml: is not what tether fit"),
            std::string::npos);
}

/// Its data are measurements for whoever changes them.
TEST_F(Twin, KeepsDataThatAPersonMadeOrChanged) {
  const std::string section =
      std::string(exact) + nothing +
      "  traces: {p: {observable: fluid.outlet.pressure, quantity: pressure, interval: 4 ms, noise: {deviation: 2 "
      "mmHg}}}\n";
  const fs::path twin = made("same", section).parent_path();
  const auto again = [&](const char* option) {
    return tether({"twin", (folder / "twin.yaml").string(), "--output", twin.string(), option});
  };
  for (const char* name : {"data/lumen.csv", "data/p.csv", "data/lumen_01.vtp", "data/lumen_77.vtp"}) {
    const std::string before = fs::exists(twin / name) ? content_of(twin / name) : "";
    std::ofstream(twin / name) << "mine";
    const ChildEnd refused = again("--quiet");
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_EQ(refused.errors, (twin / name).string() +
                                  ": is not as tether twin made it, and would be replaced; keep it elsewhere, or give "
                                  "--overwrite\n");
    EXPECT_EQ(content_of(twin / name), "mine");
    const ChildEnd replaced = again("--overwrite");
    EXPECT_EQ(replaced.exit_code, 0) << replaced.errors;
    EXPECT_TRUE(before.empty() ? !fs::exists(twin / name) : content_of(twin / name) == before) << name;
  }
  EXPECT_EQ(again("--quiet").exit_code, 0);
}

TEST_F(Twin, TellsWhatIsWrong) {
  const auto error_of = [&](const std::string& section) {
    const fs::path file = folder.file("wrong.yaml", "base: model.yaml\nname: wrong\n" + section);
    return tether({"twin", file.string(), "--output", (folder / "wrong").string()}).errors;
  };
  const std::string file = (folder / "wrong.yaml").string();
  EXPECT_EQ(error_of(""), file + ":1: twin: must be given, to make a twin\n");
  EXPECT_EQ(error_of("twin: {truth: same.yaml}\n"),
            file + ":3: twin.hidden.verdict: must be 'missing' or 'ambiguous' with effects, and another one without\n");
  EXPECT_EQ(error_of("twin: {truth: none.yaml, hidden: {verdict: nothing_missing}}\n"),
            file + ":3: twin.truth: none.yaml: no such file or folder: " + (folder / "none.yaml").string() +
                " (case file of the run that the data are made from)\n");
  EXPECT_EQ(error_of("twin: {truth: same.yaml, hidden: {verdict: nothing_missing}, traces: {lumen: {observable: p, "
                     "quantity: pressure, interval: 4 ms, noise: {deviation: 2 mmHg}}}}\n"),
            file + ":3: twin.traces.lumen: data/lumen.csv lists the surfaces: another name is needed\n");
  const ChildEnd validated =
      tether({"validate", folder.file("wrong.yaml", "base: model.yaml\nname: w\ntwin: {sed: 3}\n").string()});
  EXPECT_NE(validated.errors.find("twin.sed: unknown field; did you mean 'seed'?"), std::string::npos)
      << validated.errors;
  fs::create_directories(folder / "wrong");
  std::ofstream(folder / "wrong" / "thesis.txt") << "precious";
  EXPECT_NE(error_of("twin: {truth: same.yaml, hidden: {verdict: nothing_missing}}\n")
                .find("holds files that are not what tether twin made; choose another folder"),
            std::string::npos);
  EXPECT_NE(tether({"score", (folder / "model.yaml").string()}).errors.find("not the folder of a twin"),
            std::string::npos);
}

}  // namespace twin_test
}  // namespace tether
