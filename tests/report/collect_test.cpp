/// What a report shows of folders as `tether compare`, `diagnose`, `identify` and `explain` leave them.
#include "report/collect.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "tests/io/temporary_folder.hpp"

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
  EXPECT_EQ(report["notes"][0],
            "The moving wall is not shown: " + (folder / "wall.json").string() + ": cannot be read");
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

}  // namespace collect_test
}  // namespace tether
