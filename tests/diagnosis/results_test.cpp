/// Every result is read as it was written, and what is not as its schema says is told by file and field.
#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "identification_master/results/estimate.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace results_test {

Finding contact() {
  Finding finding;
  finding.name = "contact";
  finding.where = "spine";
  finding.accepted = true;
  finding.z = 9.5;
  finding.amplitude = {"solid.effects.contact.stiffness", "of \"tissue\"", 1e6, 0.5e6, 2e6, "g/(cm2 s2)", 0, false};
  finding.parameters = {finding.amplitude};
  finding.group = "1";
  finding.cosine = 1;
  finding.held_out_gain = Gain{0.5, 0.4, 0.6, 2, 1, 0.99};
  return finding;
}

Diagnosis diagnosis() {
  Diagnosis d;
  d.verdict = Verdict::ambiguous;
  d.statement.alike = {{"a", "b"}};
  d.sentences = {"AMBIGUOUS: ..."};
  d.case_name = "tube";
  d.effects = {contact()};
  d.look_alike = MatrixXd::Identity(2, 2);
  d.detectable = {{"contact", "spine", "stiffness", 3, "1", 0, 0.2}};
  d.lack_of_fit.before = LackOfFitFound{0.01, 5, 3, "spine", PatternForm::end_to_end, 0.25, -4};
  d.strained_errors = {{"misregistration at ct", 2.5, "x", -0.12, "cm"}};
  d.noise_factors = {{"observations.surfaces.ct", 1.16}, {"observations.traces.p", 1.0}};
  d.split_by = FurtherData{{"pressure", "2 mmHg", 14, 0.86, true}, {{"flow", "", 3, 0.2, false}}};
  d.path = {{"contact", "stiffness", "spine", false, Objection::too_weak, "", 9, 8, {}}};
  d.suggested_case = "suggested.yaml";
  d.cost = {12, 8, 0, 3, 4.5};
  return d;
}

/// A second text is the same as the first if all that the first says was read.
template <class Result>
void expect_round_trip(const Result& result) {
  const std::string text = json_of(result);
  EXPECT_EQ(json_of(record_of<Result>(text, "file")), text);
}

TEST(Results, AreReadAsTheyWereWritten) {
  expect_round_trip(diagnosis());
  Explanation explanation;
  explanation.verdict = Verdict::missing;
  explanation.effects = {contact()};
  explanation.models.emplace_back();
  explanation.models[0].objection = Objection::misfit_stays;
  explanation.models[0].held_out = Misfit{0.1, 2};
  explanation.models[0].added = {contact()};
  explanation.steps = {{"a step", "folder", 1, 2, "key"}};
  expect_round_trip(explanation);
  ComparisonResult comparison;
  comparison.sources.emplace_back();
  comparison.sources[0].registration = RegistrationTold{{1, 2, 3}, {0, 0, 0.1}, {4, 5, 6}, 0.2, 0.1, true};
  comparison.sources[0].training.judgement.visible_offset = {{"spine", 0.1}};
  comparison.sources[0].moments.push_back({0.1, true, {{"ct", 3, {}}}, {GroupTold{}}});
  comparison.traces.emplace_back();
  comparison.velocities.emplace_back();
  comparison.velocities[0].moments.emplace_back();
  expect_round_trip(comparison);
  expect_round_trip(ForceFound{
      {{"spine", "force_spine", "Pa", {0, 1}, {2, 3}, {1, 2}, {3, 4}, {{{"un", 1, 2, {"vn"}}}, 0.5, true, "1*un"}}},
      {"spine: ..."},
      "suggested.yaml"});
  Estimate estimate;
  estimate.parameters = {
      {"wall", {{"solid.material.young", 1e6}}, "Pa", "log2", {1, 2, 3, 4, 5}, {2, 1, 3, 0.5, 0.1}, Bound::upper, 0.8}};
  estimate.covariance_of_theta = MatrixXd::Constant(1, 1, 0.01);
  expect_round_trip(estimate);
}

TEST(Results, ReadWhatTheyHold) {
  const Diagnosis read = record_of<Diagnosis>(json_of(diagnosis()), "file");
  EXPECT_EQ(read.verdict, Verdict::ambiguous);
  EXPECT_EQ(read.path[0].objection, Objection::too_weak);
  EXPECT_EQ(read.lack_of_fit.before->worst_form, PatternForm::end_to_end);
  EXPECT_FALSE(read.lack_of_fit.after);
  EXPECT_EQ(read.look_alike, MatrixXd(MatrixXd::Identity(2, 2)));
  EXPECT_EQ(read.split_by->others[0].measurement, "flow");
}

/// What a person should know beside a diagnosis: of its noise, of what to measure next, of moments foretold.
TEST(Results, RemarksAreOfWhatIsNoteworthy) {
  Diagnosis d = diagnosis();
  const auto says = [&](const std::string& words) {
    const std::vector<std::string> all = remarks_on(d, HeldOutGain::told);
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("The noise of observations.surfaces.ct is taken for 1.16 times what is stated"));
  EXPECT_FALSE(says("observations.traces.p")) << "as stated";
  EXPECT_TRUE(says("Measuring pressure would tell them apart (chance 86 %; 2 mmHg)"));
  d.split_by->tells = false;
  EXPECT_TRUE(
      says("Of the measurements that were weighed none would tell them apart. The best is pressure (chance 86 %"));
  d.split_by->probability = 0.001;
  EXPECT_TRUE(says("(chance below 1 %")) << "nothing has a chance of nought";
  d.effects[0].accepted = true;
  EXPECT_TRUE(says("Not confirmed: no frames are held out"));
  d.table.groups.emplace_back().foretold = PhaseGain{20, 4, 10, 9, 0.999};
  EXPECT_TRUE(says("Each moment foretold from the others: better with it for 9 of 10"));
  EXPECT_FALSE(says("Not confirmed"));
  Finding spring = contact();
  spring.name = "visco_elastic";
  spring.accepted = false;
  spring.rival = true;
  d.effects.push_back(spring);
  d.table.groups[0].members = {{"contact", {}, "spine", CandidateKind::effect, 1.0, {}, "", true},
                               {"visco_elastic", {}, "spine", CandidateKind::effect, 0.1, {}, "", true}};
  EXPECT_FALSE(says("If errors are as stated")) << "it is not improbable";
  d.table.groups[0].members[1].share = 1e-6;
  EXPECT_TRUE(says("If errors are as stated it is not visco_elastic at spine (below 2 %)"));
  EXPECT_FALSE(says("The table adds up")) << "it has what was accepted";
  d.table.groups[0].members[0].where = "spine, inlet half";
  d.table.groups[0].members.pop_back();
  d.table.groups[0].probability = 0.99;
  EXPECT_TRUE(says("Runs of all together ask for contact at spine, and not for contact at spine, inlet half"));
  d.table.groups[0].members.push_back({"contact", {}, "spine", CandidateKind::effect, 1e-6, {}, "", true});
  EXPECT_TRUE(says("Runs of all together ask for contact at spine")) << "a member that is hardly one";
  d.verdict = Verdict::undecided;
  EXPECT_TRUE(says("none would show whether it is there. The best is pressure"));
}

TEST(Results, AnErrorThatIsAllowedIsToldWithItsSize) {
  Diagnosis d = diagnosis();
  d.effects.clear();
  const auto says = [&](const std::string& words) {
    const std::vector<std::string> all = remarks_on(d, HeldOutGain::told);
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("see to them: misregistration at ct, x -0.12 cm (2.5 times the deviation that is allowed)"));
  d.strained_errors = {{"solid.material.young", 3, "solid.material.young", 2e6, "Pa"}};
  EXPECT_TRUE(says("see to them: solid.material.young, 2e+06 Pa (3.0 times"));
  d.strained_errors = {{"error of the model's step and mesh", 3, {}, {}, "1"}};
  EXPECT_TRUE(says("see to them: error of the model's step and mesh (3.0 times"));
}

/// What is said of a law is of its own group, not of that of the mesh, which leads; and what it leaves is said though
/// others would do as well.
TEST(Results, WhatIsSaidOfALawIsOfItsGroup) {
  Diagnosis d = diagnosis();
  const auto says = [&](const std::string& words) {
    const std::vector<std::string> all = remarks_on(d, HeldOutGain::told);
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.find(words) != std::string::npos; });
  };
  Finding mesh = contact();
  mesh.name = "coarse_mesh", mesh.where = "", mesh.parameter = {}, mesh.kind = CandidateKind::numerics;
  Finding spring = contact();
  d.effects = {mesh, contact(), spring};
  for (Finding& finding : d.effects) finding.accepted = true;
  d.effects[2].name = "visco_elastic", d.effects[2].accepted = false, d.effects[2].rival = true;
  AlternativeGroup of_mesh, of_law;
  of_mesh.probability = of_mesh.least_probability = 1;
  of_mesh.foretold = PhaseGain{20, 4, 10, 3, 0.999};
  of_mesh.members = {{"coarse_mesh", {}, "", CandidateKind::numerics, 1.0, {}, "", true}};
  of_law.probability = 0.98, of_law.least_probability = 0.74;
  of_law.foretold = PhaseGain{20, 4, 10, 9, 0.999};
  of_law.members = {{"contact", {}, "spine", CandidateKind::effect, 0.7, {}, "", true},
                    {"visco_elastic", {}, "spine", CandidateKind::effect, 0.3, {}, "", true},
                    {"fibres", {}, "spine", CandidateKind::effect, 1e-9, {}, "", true}};
  for (Alternative& member : of_law.members) member.parameter = d.effects[1].parameter;
  d.table.groups = {of_mesh, of_law};
  d.table.otherwise = {{}};
  d.verdict = Verdict::ambiguous;
  EXPECT_TRUE(says("better with it for 9 of 10"));
  EXPECT_TRUE(says("Amounts are those that fit on this mesh and step"));
  EXPECT_TRUE(says("Its probability is 98 %, and at least 74 %"));
  EXPECT_TRUE(says("Of these the probability is: contact"));
  EXPECT_TRUE(says("70 %, visco_elastic")) << "the second";
  EXPECT_TRUE(says("30 %, others below 2 %"));
  d.effects[1].accepted = false;
  EXPECT_FALSE(says("Amounts are those")) << "of a mesh alone";
  d.effects[1].accepted = true;
  d.table.groups[1].members[1].share = 1e-6;
  EXPECT_TRUE(says("If errors are as stated it is not visco_elastic"));
  EXPECT_FALSE(says("Of these the probability is")) << "one is sure";

  d.lack_of_fit.after = d.lack_of_fit.before;
  d.lack_of_fit.after->p = 0.5;
  d.doubtful = false;
  EXPECT_FALSE(says("Something smaller is left") || says("More is left than noise"));
  d.doubtful = true;
  EXPECT_TRUE(says("More is left than noise and the errors allowed make in one of twenty data sets; farthest off: "));
  d.lack_of_fit.after->p = 1e-3;
  EXPECT_TRUE(says("Something smaller is left: "));
  d.lack_of_fit.after->p = 0.5;
  d.located.after = LocatedMisfit{};
  d.located.after->z = 6.5;
  d.verdict = Verdict::undecided;
  EXPECT_NE(headline_of(d).find("what that leaves is not noise"), std::string::npos);
}

TEST(Results, AWorseModelIsToldAsThat) {
  Diagnosis d = diagnosis();
  d.held_out = Gain{.value = -0.52, .lower = -1.13, .upper = -0.02, .before = 1.4, .after = 2.1};
  const std::vector<std::string> all = remarks_on(d, HeldOutGain::told);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const auto& one) {
    return one == "Held-out frames: 52 % more distance (2 .. 113) with it, 2.1 times the noise instead of 1.4";
  })) << ::testing::PrintToString(all);
}

/// What is more probable than nothing is told beside it, whatever the verdict rests on.
TEST(Results, NothingMissingTellsWhatIsNotRuledOut) {
  Diagnosis d = diagnosis();
  d.verdict = Verdict::nothing_missing;
  d.effects.clear();
  d.table.nothing = 0.29;
  AlternativeGroup& ring = d.table.groups.emplace_back();
  ring.members = {{"loose_ring", {}, "inlet_ring", CandidateKind::effect, 1.0, {}, "", true}};
  ring.least_probability = 0.11;
  const auto is_said = [&](double probability) {
    ring.probability = probability;
    const std::vector<std::string> all = remarks_on(d, HeldOutGain::told);
    return std::any_of(all.begin(), all.end(), [](const auto& one) {
      return one ==
             "It is not ruled out that loose_ring at inlet_ring is: its probability is 46 %, at least 11 % whatever is "
             "assumed, that of nothing 29 %. These data cannot tell";
    });
  };
  EXPECT_TRUE(is_said(0.456));
  EXPECT_FALSE(is_said(0.28)) << "less probable than nothing";
}

/// As a schema has it: 2.0 is a whole number, 2.5 is none.
TEST(Results, WholeNumbersMayHaveAPoint) {
  Diagnosis given = diagnosis();
  given.cost.runs = 17;
  const std::string text = json_of(given), whole = "\"runs\": 17";
  const auto with = [&](const std::string& other) {
    return std::string(text).replace(text.find(whole), whole.size(), "\"runs\": " + other);
  };
  EXPECT_EQ(record_of<Diagnosis>(with("17.0"), "d.json").cost.runs, 17);
  EXPECT_EQ(message_of([&] { record_of<Diagnosis>(with("17.5"), "d.json"); }),
            "d.json: cost.runs: 17.5: must be a whole number");
  for (const std::string large : {"3000000000", "-3000000000", "1e10", "99999999999999999999", "1e300"})
    EXPECT_NE(message_of([&] {
                record_of<Diagnosis>(with(large), "d.json");
              }).find(": must be a whole number from -2147483648 to 2147483647"),
              std::string::npos)
        << large;
  EXPECT_EQ(message_of([&] { record_of<Diagnosis>(with("17, \"runs\": 18"), "d.json"); }),
            "d.json: runs: stands twice in one object: must stand once");
}

TEST(Results, TellFileAndFieldOfWhatIsWrong) {
  const auto message = [](const std::string& text) {
    return message_of([&] { record_of<Diagnosis>(text, "d.json"); });
  };
  EXPECT_EQ(message("{"), "d.json: is no JSON");
  EXPECT_EQ(message("{}"), "d.json: verdict: is missing");
  EXPECT_TRUE(
      message(R"({"verdict": "perhaps"})").starts_with("d.json: verdict: \"perhaps\": must be one of missing, "));
  std::string text = json_of(diagnosis());
  const std::string number = "\"z\": 9.5";
  text.replace(text.find(number), number.size(), "\"z\": \"high\"");
  EXPECT_EQ(message(text), "d.json: effects[0].z: \"high\": must be a number or null");
}

}  // namespace results_test
}  // namespace tether
