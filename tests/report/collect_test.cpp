/// What a report shows of folders as `tether compare`, `diagnose`, `identify` and `explain` leave them.
#include "report/collect.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* comparison = R"({
 "case": "tube", "title": "A <b>tube</b>", "units": {"system": "cgs", "length": "cm", "time": "s"},
 "sentences": ["ct: spine, 0.1 s: the model lies 1 mm too far outward, 6 sigma"],
 "sources": [{"name": "ct", "kind": "surfaces", "series": ["ct"], "regions": ["spine"],
   "noise": {"deviation": 0.02, "correlation_length": 0.5, "correlation_time": 0}, "notes": ["two holes"], "frames": 1,
   "frames_outside_the_run": [],
   "training": {"verdict": {}, "all_frames": [{"series": null, "region": null, "l2": 0.1}, {"series": "ct", "region": null, "l2": 0.1}]},
   "held_out": {"verdict": {}, "all_frames": []},
   "moments": [{"time": 0.1, "held_out": false, "frames": [{"series": "ct", "frame": 0, "time": 0.1}],
     "groups": [{"series": null, "region": "spine", "l2": 0.2}, {"series": "ct", "region": "spine", "l2": 0.2}]}]}],
 "traces": [], "velocities": []
})";
constexpr const char* diagnosis =
    R"({"verdict": "nothing_missing", "sentences": ["NOTHING MISSING: ..."], "case": "tube",
 "title": "A tube", "effects": [], "detectable": [], "path": []})";
constexpr const char* estimate = R"({"case": "tube", "title": "A tube", "parameters": [{"name": "wall"}]})";

class Collect : public testing::Test {
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
  EXPECT_EQ(report["notes"][0], "The moving wall is not shown: the case file of these results is not where it was");
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
  write("case_as_run.yaml", fmt::format("# Copy of {} as it was when the run started.\nname: tube\n",
                                        (folder / "tube/case.yaml").string()));
  const Json report = document();
  EXPECT_EQ(report["verdict"], "nothing_missing");
  const Json provenance = report["provenance"];
  EXPECT_NE(provenance["cases"][0]["text"].get<std::string>().find("name: tube"), std::string::npos);
  ASSERT_EQ(provenance["files"].size(), 1U);
  EXPECT_EQ(provenance["files"][0]["field"], "fluid.curve");
  EXPECT_EQ(provenance["files"][0]["bytes"], 5);
  EXPECT_EQ(provenance["seeds"], Json::parse(R"([{"field": "twin.seed", "value": "7"}])"));
}

TEST_F(Collect, AnExplanation) {
  const char* explain =
      R"({"case": "tube", "title": "A tube", "verdict": "missing", "sentences": ["MISSING: x"], "best": 1,
    "models": [{"number": 0, "name": "as given", "case": "model_0.yaml", "run": "model_0", "diagnosis": "diagnosis_0", "identification": null},
               {"number": 1, "name": "with x", "case": "model_1.yaml", "run": "model_1", "diagnosis": null, "identification": "identification_1"},
               {"number": 2, "name": "with y", "case": "model_2.yaml", "run": "model_2", "diagnosis": null, "identification": null}],
    "missing_force": "force/force.json"})";
  write("explain.json", explain);
  write("model_0/comparison.json", comparison);
  write("model_0/summary.json", R"({"steps": 8, "cpu_seconds": {"total": 2.5}, "effective_case": {"fluid": 1}})");
  write("model_1/comparison.json", comparison);
  write("diagnosis_0/diagnosis.json", diagnosis);
  write("identification_1/estimate.json", estimate);
  write("force/force.json", R"({"regions": []})");
  write("force/run/comparison.json", comparison);
  const Json report = document();
  EXPECT_EQ(report["kind"], "explain");
  EXPECT_EQ(report["explain"], Json::parse(explain)) << "as it is";
  ASSERT_EQ(report["runs"].size(), 3U) << "before, the best, and with what is still missing";
  EXPECT_EQ(report["runs"][0]["label"], "before: as given");
  EXPECT_EQ(report["runs"][1]["label"], "after: with x");
  EXPECT_EQ(report["runs"][2]["folder"], "force/run");
  EXPECT_EQ(report["diagnoses"][0]["label"], "model 0");
  EXPECT_EQ(report["estimates"][0]["label"], "model 1");
  EXPECT_TRUE(report["estimates"][0]["over_time"].is_null()) << "there is no table";
  EXPECT_TRUE(report["force"].contains("regions"));
  EXPECT_EQ(report["provenance"]["runs"][0]["summary"]["steps"], 8);
  EXPECT_FALSE(report["provenance"]["runs"][0]["summary"].contains("effective_case"));
}

TEST_F(Collect, WhatCannotBeReported) {
  EXPECT_EQ(message_of([&] { collected(folder.path()); }),
            folder.path().string() + ": holds no explain.json, comparison.json, diagnosis.json or estimate.json");
  write("comparison.json", "{");
  EXPECT_TRUE(message_of([&] { collected(folder.path()); }).starts_with((folder / "comparison.json").string() + ": "));
  write("comparison.json", "{}");
  EXPECT_THROW(collected(folder.path()), InputError);
}

}  // namespace
}  // namespace tether
