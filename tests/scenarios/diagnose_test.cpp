/// `tether diagnose` with the real programs on a coarse configs/tube without the spine's support, against data with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/valid_results.hpp"

namespace tether {
namespace diagnose_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

ChildEnd tether(const std::vector<std::string>& words) {
  std::vector<std::string> line{TETHER_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  return capture({line, {}});
}

constexpr const char* model = R"(base: {}/configs/tube/case.yaml
name: model
time: {{step: 4e-3, end: 0.12}}
mesh: {{swept: {{around: 12, along: 8}}}}
solid: {{support: {{regions: {{spine: {{stiffness: 0}}}}}}}}
diagnosis:
  candidates: [{}]
  exclude: [vicinity_left, vicinity_right, fluid.density]
  numerics: {}
twin:
  truth: {}.yaml
  frames: 8
  image: {{voxel: [0, 0, 0]}}
  noise: {{deviation: {} mm, correlation_length: 5 mm}}
  held_out: [3, 6]
  hidden: {}
)";

class Diagnose : public ::testing::Test {
 protected:
  /// The model's case, which a twin's builds on.
  fs::path written(const std::string& candidates, const std::string& truth, const std::string& hidden,
                   double noise = 0.03) const {
    return folder.file("model.yaml",
                       fmt::format(model, TETHER_SOURCE, candidates, truth == "same", truth, noise, hidden));
  }
  void make_twin(const std::string& truth, const std::string& hidden, const std::string& candidates = "tissue_mass",
                 double noise = 0.03) const {
    const fs::path file = written(candidates, truth, hidden, noise);
    folder.file("same.yaml", "base: model.yaml\nname: same\ntwin: ~\n");
    folder.file("held.yaml",
                "base: model.yaml\nname: held\ntwin: ~\nsolid: {support: {regions: {spine: {stiffness: 4e5}}}}\n");
    const ChildEnd made = tether({"twin", file.string(), "--output", (folder / "twin").string()});
    ASSERT_EQ(made.exit_code, 0) << made.errors;
  }
  Json diagnosed(const std::string& truth, const std::string& hidden) const {
    make_twin(truth, hidden);
    return again();
  }
  Json again() const {
    const ChildEnd end = tether({"diagnose", (folder / "twin/case.yaml").string(), "--output", output().string()});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    said = end.output;
    return Json::parse(content_of(output() / "diagnosis.json"));
  }
  void TearDown() override { expect_valid_results(folder.path()); }
  fs::path output() const { return folder / "out"; }

  TemporaryFolder folder;
  mutable std::string said;
};

TEST_F(Diagnose, FindsTheHiddenSupport) {
  const std::string spring = "{effects: {visco_elastic: {where: spine, amplitude: 4e5, unit: g/(cm2 s2)}}}";
  const Json found = diagnosed("held", spring);
  EXPECT_EQ(found["verdict"], "missing") << said;
  const Json first = found["effects"][0];
  EXPECT_EQ(first["name"], "visco_elastic") << said;
  EXPECT_EQ(first["where"], "spine");
  EXPECT_TRUE(first["accepted"]);
  EXPECT_LT(first["amplitude"]["lower"], 4e5);
  EXPECT_GT(first["amplitude"]["upper"], 4e5);
  EXPECT_GT(first["held_out_gain"]["lower"], 0);
  EXPECT_NE(said.find("MISSING: visco_elastic stiffness at spine"), std::string::npos) << said;

  const ChildEnd valid = tether({"validate", (output() / "suggested.yaml").string()});
  EXPECT_EQ(valid.exit_code, 0) << valid.errors;
  const ChildEnd scored = tether({"score", (folder / "twin").string(), "--output", output().string()});
  EXPECT_NE(scored.output.find("verdict: missing: right"), std::string::npos) << scored.output << scored.errors;
  const fs::path lumen = folder / "twin/data/lumen_03.vtp", kept_lumen = folder / "kept.vtp";
  fs::rename(lumen, kept_lumen);
  fs::copy_file(folder / "twin/data/lumen_04.vtp", lumen);
  const ChildEnd of_others = tether({"score", (folder / "twin").string(), "--output", output().string()});
  EXPECT_EQ(of_others.exit_code, 2);
  EXPECT_NE(of_others.errors.find("diagnosis.json: is of other data than "), std::string::npos) << of_others.errors;
  fs::rename(kept_lumen, lumen);

  const Json kept = again();
  EXPECT_EQ(kept["verdict"], "missing");
  EXPECT_EQ(kept["cost"]["runs_made"], 0) << "all runs are there";
  const std::string made = content_of(output() / "suggested.yaml");
  std::ofstream(output() / "suggested.yaml", std::ios::app) << "# mine\n";
  const ChildEnd refused = tether({"diagnose", (folder / "twin/case.yaml").string(), "--output", output().string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("suggested.yaml: is not as tether diagnose made it"), std::string::npos)
      << refused.errors;
  std::ofstream(output() / "suggested.yaml") << made;

  make_twin("held", spring, "tissue_mass, contact", 0.1);
  const Json alike = again();  // until 0.12 s the wall moves outward only, where a contact is a spring
  EXPECT_EQ(alike["verdict"], "ambiguous") << said;
  std::vector<std::string> group;
  for (const Json& effect : alike["effects"])
    if (effect["group"] == "1" && effect["where"] == "spine") group.push_back(effect["name"]);
  EXPECT_NE(std::find(group.begin(), group.end(), "contact"), group.end()) << said;
  EXPECT_NE(std::find(group.begin(), group.end(), "visco_elastic"), group.end()) << said;
}

/// Runs that show what each number does, of what `tether diagnose --plan` says.
int planned_first_order(const std::string& plan) {
  const std::string before = "runs       ";
  const auto at = plan.find(before);
  return at == std::string::npos ? -1 : std::stoi(plan.substr(at + before.size()));
}

TEST_F(Diagnose, TellsBeforeItBeginsWhatItWouldTake) {
  const std::string spring = "{effects: {visco_elastic: {where: spine, amplitude: 4e5, unit: g/(cm2 s2)}}}";
  const Json found = diagnosed("held", spring);
  const ChildEnd plan = tether({"diagnose", (folder / "twin/case.yaml").string(), "--plan", "--processes", "3",
                                "--output", (folder / "planned").string()});
  ASSERT_EQ(plan.exit_code, 0) << plan.errors;
  const int planned = planned_first_order(plan.output);
  EXPECT_LE(planned, found["cost"]["sensitivity_runs"]) << "which has parts of places too";
  EXPECT_NE(said.find(fmt::format("run 1 of {}: ", planned - 1)), std::string::npos) << "beside the model as it is\n"
                                                                                     << plan.output << said;
  EXPECT_NE(said.find("  left "), std::string::npos) << said;
  EXPECT_NE(plan.output.find("3 models at once"), std::string::npos) << plan.output;
  EXPECT_NE(plan.output.find("30 steps of"), std::string::npos) << plan.output;
  EXPECT_NE(plan.output.find("of the coarser model 15 steps of"), std::string::npos) << plan.output;
  EXPECT_FALSE(fs::exists(folder / "planned")) << "nothing has begun";
}

/// By somebody else, while the group of programs starts: no run is made of data that are read already.
TEST_F(Diagnose, RunsNothingWhereMeasurementsAreWrittenMeanwhile) {
  make_twin("same", "{verdict: nothing_missing}");
  fs::permissions(
      folder.file("twin/late.sh", fmt::format("#!/bin/sh\necho >> {}/twin/data/lumen_03.vtp\n"
                                              "exec {}/fluid \"$@\"\n",
                                              folder.path().string(), fs::path(TETHER_PROGRAM).parent_path().string())),
      fs::perms::owner_all);
  const fs::path file =
      folder.file("twin/late.yaml", "base: case.yaml\nname: late\ncoupling: {programs: {fluid: ./late.sh}}\n");
  const ChildEnd ended = tether({"diagnose", file.string(), "--output", output().string(), "--processes", "1"});
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  EXPECT_NE(ended.errors.find("lumen_03.vtp: was written during the run"), std::string::npos) << ended.errors;
  EXPECT_EQ(ended.output.find("run 1 of"), std::string::npos) << ended.output;
  EXPECT_FALSE(fs::exists(output() / "diagnosis.json"));
}

/// Of the published quantities of one model.
double published(const Json& model, const std::string& name) {
  for (const Json& quantity : model["quantities"])
    if (quantity["quantity"] == name) return quantity["value"];
  ADD_FAILURE() << "no " << name << " in " << model;
  return 0;
}

/// Another noise and another name: another data set of the same model.
TEST_F(Diagnose, SharesRunsBetweenDataSetsOfOneModel) {
  const Json alone = diagnosed("held", "{effects: {visco_elastic: {where: spine, amplitude: 4e5, unit: g/(cm2 s2)}}}");
  const auto with = [&](const std::string& name, const std::string& words) {
    const fs::path file = folder.file(name + ".yaml", "base: twin/case.yaml\nname: " + name + "\n" + words);
    const ChildEnd end = tether(
        {"diagnose", file.string(), "--output", (folder / name).string(), "--runs", (folder / "shared").string()});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    said = end.output;
    return Json::parse(content_of(folder / name / "diagnosis.json"));
  };
  const Json first = with("first", "");
  EXPECT_EQ(first["cost"]["runs_made"], alone["cost"]["runs_made"]) << "those of another folder are not known here";
  EXPECT_EQ(first["effects"], alone["effects"]) << "the same as with a folder of its own";

  const Json second = with("second", "observations: {surfaces: {twin: {noise: {deviation: 0.036 mm}}}}\n");
  const int of_first_order = second["cost"]["sensitivity_runs"];
  EXPECT_LE(of_first_order, first["cost"]["sensitivity_runs"]) << "it cuts no place that the first did not cut";
  EXPECT_GT(of_first_order, 20) << "those of all numbers";
  EXPECT_LE(second["cost"]["runs_made"], second["cost"]["runs"].get<int>() - of_first_order - 1)
      << "none of what numbers do, nor of the model as it is\n"
      << said;
  EXPECT_TRUE(fs::is_symlink(folder / "second/coarse/runs/base"));
  EXPECT_EQ(with("third", "")["cost"]["runs_made"], 0) << "the same data under another name";

  const Json other = with("other", "solid: {viscosity: 5e2}\n");
  EXPECT_GE(other["cost"]["runs_made"], of_first_order) << "another model: its runs are all its own";

  ASSERT_EQ(first["published"].size(), 2U) << said;
  const Json before = first["published"][0], after = first["published"][1];
  EXPECT_EQ(before["model"], "as_it_is");
  EXPECT_EQ(after["model"], "accepted");
  EXPECT_LT(published(after, "distensibility"), published(before, "distensibility")) << "springs hold the wall";
  EXPECT_GT(published(after, "pulse_wave_velocity"), published(before, "pulse_wave_velocity"));
  for (const Json& quantity : after["quantities"]) {
    EXPECT_LE(quantity["lower"], quantity["value"]) << quantity;
    EXPECT_GE(quantity["upper"], quantity["value"]) << quantity;
  }
  EXPECT_NE(said.find("what it changes (95 %)"), std::string::npos) << said;
}

/// Only the programs know the names of their numbers.
TEST_F(Diagnose, KeepsWhatWasFoundBeforeWhereACaseIsRefused) {
  make_twin("same", "{verdict: nothing_missing}");
  const fs::path wrong = folder.file(
      "twin/wrong.yaml", "base: case.yaml\nname: wrong\ndiagnosis: {assumed: [solid.material.yuong], coarse: false}\n");
  const std::string mark = fmt::format("# case_file: {}\nname: wrong\n", wrong.string());
  fs::create_directories(output());
  folder.file("out/case_as_run.yaml", mark);
  const std::vector<std::string> earlier{"diagnosis.json", "explain.json", "report.html"};
  for (const std::string& name : earlier) folder.file("out/" + name, "earlier");
  for (const char* verb : {"diagnose", "explain"}) {
    const ChildEnd end = tether({verb, wrong.string(), "--output", output().string()});
    EXPECT_EQ(end.exit_code, 2) << end.output;
    EXPECT_NE(end.errors.find("yuong"), std::string::npos) << end.errors;
    for (const std::string& name : earlier) EXPECT_EQ(content_of(output() / name), "earlier") << verb << ": " << name;
    EXPECT_EQ(content_of(output() / "case_as_run.yaml"), mark) << verb;
    EXPECT_FALSE(fs::exists(output() / "model_0")) << "refused before anything runs";
  }
  for (const std::string& name : earlier) fs::remove(output() / name);  // are none
}

TEST_F(Diagnose, FindsNothingWhereNothingIsHidden) {
  const Json found = diagnosed("same", "{verdict: nothing_missing}");
  EXPECT_EQ(found["verdict"], "nothing_missing") << said;
  std::vector<std::string> numerics;
  for (const Json& effect : found["effects"]) {
    EXPECT_FALSE(effect["accepted"]) << effect;
    if (effect["kind"] == "numerics") numerics.push_back(effect["name"]);
  }
  std::sort(numerics.begin(), numerics.end());
  EXPECT_EQ(numerics, (std::vector<std::string>{"coarse_mesh", "long_step"}));
  EXPECT_TRUE(found["suggested_case"].is_null());

  const auto refused = [&](const std::string& words) {
    const fs::path file = folder.file("odd.yaml", "base: twin/case.yaml\ndiagnosis: {" + words + "}\n");
    const ChildEnd end = tether({"diagnose", file.string(), "--output", (folder / "odd").string(), "--overwrite"});
    EXPECT_EQ(end.exit_code, 2) << words;
    return end.output + end.errors;
  };
  const auto says = [&](const std::string& words, const std::string& answer) {
    const std::string all = refused(words);
    EXPECT_NE(all.find(answer), std::string::npos) << all;
  };
  says("candidates: [visco_elastik]", "did you mean visco_elastic?");
  says("exclude: [vicinity_lefft]", "did you mean vicinity_left?");
  says("assumed: [solid.material.yung]", "did you mean solid.material.young?");
}

}  // namespace diagnose_test
}  // namespace tether
