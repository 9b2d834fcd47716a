/// What a report shows of folders as `tether compare`, `diagnose`, `identify` and `explain` leave them.
#include "report/collect.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/config/input_files.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/io/work.hpp"

namespace tether {
namespace collect_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Of one region and one contour.
GroupTold group(std::optional<std::string> series, std::optional<std::string> region, double rms) {
  GroupTold made;
  made.series = std::move(series);
  made.region = std::move(region);
  made.rms = rms;
  return made;
}

std::string comparison_text() {
  ComparisonResult made;
  made.case_name = "tube";
  made.title = "A <b>tube</b>";
  made.units = {"cgs", "cm", "s"};
  made.sentences = {"ct: spine, 0.1 s: the model lies 1 mm too far outward, 6 sigma"};
  SourceCompared& ct = made.sources.emplace_back();
  ct.name = "ct";
  ct.series = {"ct"};
  ct.regions = {"spine"};
  ct.noise = {0.02, 0.5, 0};
  ct.training.all_frames = {group({}, {}, 0.1), group("ct", {}, 0.1)};
  ct.moments = {{0.1, false, {{"ct", 0, 0.1}}, {group({}, "spine", 0.2), group("ct", "spine", 0.2)}}};
  return json_of(made);
}

std::string diagnosis_text() {
  Diagnosis made;
  made.verdict = Verdict::nothing_missing;
  made.sentences = {"NOTHING MISSING: ..."};
  made.case_name = "tube";
  made.title = "A tube";
  return json_of(made);
}

std::string estimate_text() {
  Estimate made;
  made.case_name = "tube";
  made.parameters.emplace_back().name = "wall";
  return json_of(made);
}

ExplainedModel model(int number, const std::string& name, const char* diagnosis, const char* identification) {
  ExplainedModel made;
  made.number = number;
  made.name = name;
  made.run = fmt::format("model_{}", number);
  made.case_file = made.run + ".yaml";
  if (diagnosis) made.diagnosis = diagnosis;
  if (identification) made.identification = identification;
  return made;
}

const std::string comparison = comparison_text(), diagnosis = diagnosis_text(), estimate = estimate_text();

std::string summary_text() {
  RunSummary run;
  run.case_name = "tube";
  run.title = "A tube";
  run.steps = 100;
  run.time = {0, 0.2};
  run.periodicity = Periodicity{0.1, 5e-3, {{2, 0.004, 0.001}}, 2};
  run.rest = RestState{"prestressed", 1e-12, HeldBySurroundings{0.066, 0.4, {1, 2, 3}, "arch"}};
  return json_of(run);
}

class Collect : public ::testing::Test {
 protected:
  Json document() const { return Json::parse(collected(folder.path())); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    folder.file(name, text);
  }
  TemporaryFolder folder;
};

TEST_F(Collect, AComparison) {
  write("comparison.json", comparison);
  const Json report = document();
  EXPECT_EQ(report["kind"], "comparison");
  EXPECT_EQ(report["title"], "A <b>tube</b>");
  EXPECT_EQ(report["sentences"].size(), 1U);
  ASSERT_EQ(report["runs"].size(), 1U);
  EXPECT_EQ(report["runs"][0]["mm"], 10) << "a centimetre";
  const Json source = report["runs"][0]["comparison"]["sources"][0];
  EXPECT_EQ(source["training"]["all_frames"].size(), 1U) << "of regions, not of single contours";
  EXPECT_EQ(source["moments"][0]["groups"].size(), 1U);
  EXPECT_EQ(source["moments"][0]["groups"][0]["l2"], 0.2) << "the file's own figures";
  EXPECT_TRUE(report["wall"].is_null());
  ASSERT_EQ(report["notes"].size(), 1U);
  EXPECT_EQ(report["notes"][0], "The moving wall is not shown: " + (folder / "wall.json").string() + ": no such file");
}

TEST_F(Collect, ARunThatWasComparedWithNothing) {
  write("summary.json", summary_text());
  write("plots/pressures.png", "PNG");
  write("plots/flows.txt", "no picture");
  const Json report = document();
  EXPECT_EQ(report["kind"], "simulation");
  EXPECT_EQ(report["title"], "A tube");
  EXPECT_EQ(report["sentences"][0], "0.2 s of blood and wall in 100 steps, the lumen moved by at most 0 mm");
  EXPECT_NE(report["sentences"][1].get<std::string>().find("periodic since beat 2"), std::string::npos);
  EXPECT_NE(report["sentences"][2].get<std::string>().find("6.6 % of its forces"), std::string::npos);
  EXPECT_EQ(report["plots"], Json::parse(R"([{"name": "pressures", "png": "UE5H"}])"));
  EXPECT_EQ(report["provenance"]["runs"].size(), 1U);
  write("comparison.json", comparison);
  EXPECT_EQ(document()["kind"], "comparison") << "of a run that was, its comparison";
}

TEST_F(Collect, AnIdentificationThinnedOut) {
  write("estimate.json", estimate);
  std::string table = "time [s], wall [g/(cm s2)], wall.lower [g/(cm s2)], wall.upper [g/(cm s2)], wall.theta\n";
  for (int i = 0; i <= 1000; ++i) table += fmt::format("{}, {}, {}, {}, 0\n", 0.001 * i, i, i - 1, i + 1);
  write("estimate.csv", table);
  const Json report = document(), over = report["estimates"][0]["over_time"];
  EXPECT_EQ(report["kind"], "estimate");
  const auto values = over["parameters"]["wall"]["value"].get<std::vector<double>>();
  EXPECT_LE(values.size(), 301U);
  EXPECT_EQ(values.size(), over["time"].size());
  EXPECT_EQ(values.front(), 0);
  EXPECT_EQ(values.back(), 1000) << "the last";
  EXPECT_EQ(over["parameters"]["wall"]["upper"].back(), 1001);
}

TEST_F(Collect, ADiagnosisAndItsCase) {
  write("diagnosis.json", diagnosis);
  write("tube/flow.csv", "t, q\n");
  write("tube/case.yaml", "name: tube\nfluid: {curve: flow.csv}\ntwin: {seed: 7}\n");
  write("case_as_run.yaml", fmt::format("# case_file: {}\nname: tube\n", (folder / "tube/case.yaml").string()));
  const Json report = document();
  EXPECT_EQ(report["verdict"], "nothing_missing");
  EXPECT_TRUE(report["diagnoses"][0]["misfit"].is_null()) << "there is no picture";
  const Json& provenance = report["provenance"];
  EXPECT_NE(provenance["cases"][0]["text"].get<std::string>().find("name: tube"), std::string::npos);
  ASSERT_EQ(provenance["files"].size(), 1U);
  EXPECT_EQ(provenance["files"][0]["field"], "fluid.curve");
  EXPECT_EQ(provenance["files"][0]["bytes"], 5);
  EXPECT_EQ(provenance["seeds"], Json::parse(R"([{"field": "twin.seed", "value": "7"}])"));
}

TEST_F(Collect, AnExplanation) {
  Explanation made;
  made.case_name = "tube";
  made.title = "A tube";
  made.verdict = Verdict::missing;
  made.sentences = {"MISSING: x"};
  made.best = 1;
  made.models = {model(0, "as given", "diagnosis_0", nullptr), model(1, "with x", nullptr, "identification_1"),
                 model(2, "with y", nullptr, nullptr)};
  made.missing_force = "force/force.json";
  const std::string explain = json_of(made);
  write("explain.json", explain);
  write("model_0/comparison.json", comparison);
  RunSummary summary;
  summary.steps = 8;
  write("model_0/summary.json", json_of(summary));
  write("model_1/comparison.json", comparison);
  write("diagnosis_0/diagnosis.json", diagnosis);
  write("diagnosis_0/plots/misfit.png", "PNG");
  write("identification_1/estimate.json", estimate);
  write("force/force.json", json_of(ForceFound{}));
  write("force/run/comparison.json", comparison);
  const Json report = document();
  EXPECT_EQ(report["kind"], "explain");
  EXPECT_EQ(report["explain"], Json::parse(explain)) << "as it is";
  ASSERT_EQ(report["runs"].size(), 3U) << "before, the best, and with what is still missing";
  EXPECT_EQ(report["runs"][0]["label"], "before: as given");
  EXPECT_EQ(report["runs"][1]["label"], "after: with x");
  EXPECT_EQ(report["runs"][2]["folder"], "force/run");
  EXPECT_EQ(report["diagnoses"][0]["label"], "model 0");
  EXPECT_EQ(report["diagnoses"][0]["misfit"], "UE5H");
  EXPECT_EQ(report["estimates"][0]["label"], "model 1");
  EXPECT_TRUE(report["estimates"][0]["over_time"].is_null()) << "there is no table";
  EXPECT_TRUE(report["force"].contains("regions"));
  EXPECT_EQ(report["provenance"]["runs"][0]["summary"]["steps"], 8);
  EXPECT_FALSE(report["provenance"]["runs"][0]["summary"].contains("effective_case"));
}

TEST_F(Collect, WhatCannotBeReported) {
  EXPECT_EQ(message_of([&] { collected(folder.path()); }),
            folder.path().string() +
                ": holds no explain.json, comparison.json, diagnosis.json, estimate.json or summary.json");
  write("comparison.json", "{");
  EXPECT_TRUE(message_of([&] { collected(folder.path()); }).starts_with((folder / "comparison.json").string() + ": "));
  write("comparison.json", "{}");
  EXPECT_THROW(collected(folder.path()), InputError);
}

std::string explanation_text(const std::string& run, std::optional<std::string> diagnosis = {}) {
  Explanation made;
  made.case_name = "tube";
  made.models = {model(0, "as given", nullptr, nullptr)};
  made.models[0].run = run;
  made.models[0].diagnosis = std::move(diagnosis);
  return json_of(made);
}

/// A page is mailed, and a folder of results may be somebody else's.
TEST_F(Collect, NothingFromElsewhere) {
  const TemporaryFolder elsewhere;
  elsewhere.file("comparison.json", comparison), elsewhere.file("diagnosis.json", diagnosis);
  const std::string beside = "../" + elsewhere.path().filename().string();
  for (const std::string& name : {elsewhere.path().string(), beside, std::string("model_0/../..")}) {
    write("explain.json", explanation_text(name));
    EXPECT_EQ(message_of([&] { document(); }),
              (folder / "explain.json").string() + ": run: " + name + ": must name what stands in this folder");
    write("explain.json", explanation_text("model_0", name));
    EXPECT_EQ(message_of([&] { document(); }),
              (folder / "explain.json").string() + ": diagnosis: " + name + ": must name what stands in this folder");
  }
  write("explain.json", explanation_text("model_0"));
  fs::create_directories(folder / "model_0");
  fs::create_symlink(elsewhere / "comparison.json", folder / "model_0/comparison.json");
  EXPECT_EQ(message_of([&] { document(); }), (folder / "model_0/comparison.json").string() + ": leads out of " +
                                                 folder.path().string() + ": a page shows what stands in its folder");
  fs::remove(folder / "model_0/comparison.json");
  write("model_0/comparison.json", comparison);
  write("model_0.yaml", "name: tube\n");
  fs::create_symlink(elsewhere.file("secret", "a name"), folder / "model_0/case_as_run.yaml");
  const Json report = document();
  EXPECT_TRUE(report["provenance"]["cases"].empty());
  EXPECT_EQ(report["notes"].back(), "A case is not shown: " + (folder / "model_0/case_as_run.yaml").string() +
                                        ": leads out of " + folder.path().string() +
                                        ": a page shows what stands in its folder");
}

TEST_F(Collect, NoPipeAndNoFolderInThePlaceOfAFile) {
  ASSERT_EQ(mkfifo((folder / "summary.json").c_str(), 0600), 0);
  EXPECT_EQ(message_of([&] { document(); }), (folder / "summary.json").string() + ": is not a file");
  fs::remove(folder / "summary.json");
  write("summary.json", summary_text());
  write("plots/flows.png", "PNG");
  fs::create_directories(folder / "plots/walls.png");
  ASSERT_EQ(mkfifo((folder / "plots/pressures.png").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder / "case_as_run.yaml").c_str(), 0600), 0);
  const Json report = document();
  EXPECT_EQ(report["plots"], Json::parse(R"([{"name": "flows", "png": "UE5H"}])"));
  ASSERT_EQ(report["notes"].size(), 3U);
  EXPECT_EQ(report["notes"][0],
            "A picture is not shown: " + (folder / "plots/pressures.png").string() + ": is not a file");
  EXPECT_EQ(report["notes"][1], "A picture is not shown: " + (folder / "plots/walls.png").string() + ": is not a file");
  EXPECT_EQ(report["notes"][2], "A case is not shown: " + (folder / "case_as_run.yaml").string() + ": is not a file");
}

/// Sparse files, which take no disk, would take all memory.
TEST_F(Collect, NothingThatIsFarTooLarge) {
  const Work work;
  write("summary.json", summary_text());
  for (const char* name : {"plots/wall.png", "case_as_run.yaml"}) {
    write(name, "");
    fs::resize_file(folder / name, 3'000'000'000);
  }
  const Json report = document();
  EXPECT_TRUE(report["plots"].empty());
  EXPECT_EQ(report["notes"][0], "A picture is not shown: " + (folder / "plots/wall.png").string() +
                                    ": has 3000 MB: larger than any such file that is read here (16 MB)");
  EXPECT_EQ(
      report["notes"][1].get<std::string>().find("A case is not shown: " + (folder / "case_as_run.yaml").string()), 0U);
  fs::resize_file(folder / "summary.json", 3'000'000'000);
  EXPECT_EQ(message_of([&] { document(); }),
            (folder / "summary.json").string() + ": has 3000 MB: larger than any such file that is read here (64 MB)");
  write("summary.json", std::string(24'000'000, '['));
  EXPECT_EQ(message_of([&] { document(); }),
            (folder / "summary.json").string() + ": is nested deeper than any record: 64 levels");
  EXPECT_LT(work.seconds(), 5);
}

/// compare, new measurements, identify: all in one folder.
TEST_F(Collect, AWarningOfResultsOfOtherData) {
  write("case/data.csv", "t, q\n");
  const fs::path file = folder / "case/case.yaml";
  write("case/case.yaml", "name: tube\nfluid: {curve: data.csv}\nobservations: {surfaces: {ct: {file: data.csv}}}\n");
  RunSummary run;
  for (const InputFile& input : input_files(file))
    run.made_from.files.push_back({input.field, input.name, fmt::format("{:016x}", input.content)});
  write("summary.json", json_of(run));
  write("comparison.json", comparison);
  write("case_as_run.yaml", fmt::format("# case_file: {}\nname: tube\n", file.string()));
  Json report = document();
  EXPECT_TRUE(report["warnings"].empty()) << report["warnings"];
  EXPECT_EQ(report["provenance"]["files"][0]["changed"], false);
  const auto before = fs::last_write_time(folder / "comparison.json") - std::chrono::seconds(10);
  fs::last_write_time(folder / "comparison.json", before);
  write("case/data.csv", "t, q\n0, 1\n");
  fs::last_write_time(folder / "case/data.csv", before - std::chrono::seconds(10));  // as cp -p would
  write("estimate.json", estimate);
  fs::last_write_time(folder / "estimate.json", before + std::chrono::seconds(100));
  report = document();
  EXPECT_EQ(report["warnings"],
            Json::parse(R"(["The comparison of the model is of other data: data.csv was changed since"])"));
  EXPECT_EQ(report["provenance"]["files"][0]["changed"], true);
}

}  // namespace collect_test
}  // namespace tether
