#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "diagnosis/explanation/path.hpp"

namespace tether {
namespace explanation_test {

enum class Role { accepted, rival };

Finding finding(const std::string& name, CandidateKind kind, Role role, double value) {
  Finding made;
  made.name = name;
  made.where = "spine";
  made.kind = kind;
  made.accepted = role == Role::accepted;
  made.rival = role == Role::rival;
  made.group = "1";
  made.amplitude = {"solid.effects." + name + ".factor", "", value, value / 2, value * 2, "1", 0, false};
  return made;
}

Finding effect(const std::string& name, Role role, double value) {
  return finding(name, CandidateKind::effect, role, value);
}

Diagnosis diagnosis(Verdict verdict, std::vector<Finding> effects) {
  Diagnosis made;
  made.verdict = verdict;
  made.effects = std::move(effects);
  for (const Finding& found : made.effects)
    if (found.accepted && found.kind == CandidateKind::data) made.statement.wrong_data.push_back(text_of(found));
  return made;
}

PathModel model(int number, std::optional<Diagnosis> diagnosed, std::vector<Finding> added) {
  PathModel made;
  made.told.number = number;
  made.diagnosis = std::move(diagnosed);
  made.told.added = std::move(added);
  return made;
}

PathModel refused(int number, const std::string& name) {
  PathModel made = model(number, std::nullopt, {effect("of_" + name, Role::accepted, 1)});
  made.told.name = name;
  made.told.accepted = false;
  made.told.objection = Objection::not_confirmed;
  return made;
}

std::vector<std::string> said_of(const ExplanationPath& path) {
  return explanation_of(path).sentences;
}

TEST(Explanation, SaysWhatWasIdentifiedOfWhatCannotBeToldApart) {
  ExplanationPath path;
  path.models = {
      model(0, diagnosis(Verdict::ambiguous, {effect("contact", Role::accepted, 1), effect("spring", Role::rival, 3)}),
            {}),
      model(1, std::nullopt, {effect("contact", Role::accepted, 7)})};
  path.best = 1;
  EXPECT_EQ(verdict_of(path), Verdict::ambiguous);
  EXPECT_EQ(said_of(path).front(),
            "AMBIGUOUS: these data cannot tell contact at spine, factor 7 (3.5 .. 14) from spring at spine, factor "
            "about 3");
  path.models.push_back(model(2, std::nullopt, {effect("loose_ring", Role::accepted, 5)}));
  path.best = 2;
  EXPECT_TRUE(said_of(path).front().ends_with("; beside it loose_ring at spine, factor 5 (2.5 .. 10)"));
}

/// A path ends where the diagnosis said that noise is left, and the model with its effect does what was foreseen.
TEST(Explanation, EndsWhereNothingButNoiseIsLeft) {
  const auto settled = [](const std::function<void(Diagnosis&)>& change, double gain) {
    Finding spring = effect("spring", Role::accepted, 3);
    spring.held_out_gain = Gain{.value = 0.5};
    Diagnosis made = diagnosis(Verdict::missing, {spring});
    change(made);
    ExplanationPath path;
    path.models = {model(0, made, {}), refused(1, "with contact at spine"), model(2, std::nullopt, {spring})};
    path.models[2].told.gain = Gain{.value = gain};
    path.best = 2;
    return is_settled(path);
  };
  EXPECT_TRUE(settled([](Diagnosis&) {}, 0.45));
  EXPECT_FALSE(settled([](Diagnosis&) {}, 0.35)) << "less than was foreseen";
  EXPECT_FALSE(settled([](Diagnosis& made) { made.doubtful = true; }, 0.45));
  EXPECT_FALSE(settled([](Diagnosis& made) { made.more = true; }, 0.45));
  EXPECT_FALSE(settled([](Diagnosis& made) { made.verdict = Verdict::not_in_catalogue; }, 0.45));
}

/// A model that lacks something else too may fail held-out data for that: both are asked for before the first is given
/// up.
TEST(Explanation, AsksForTwoAtOnceWhereOneIsNotConfirmedAndAnotherStandsOut) {
  const auto number_of = [](const std::string& name) { return "solid.effects.of_" + name + ".factor"; };
  const auto tried = [&](const std::string& name) {
    PathModel made = refused(1, name);
    made.told.added.front().parameters = {made.told.added.front().amplitude};
    return made;
  };
  ExplanationPath path;
  path.models = {model(0, diagnosis(Verdict::missing, {}), {}), tried("spring")};
  path.models.push_back(tried("ring"));
  PathModel& best = path.models.front();
  best.diagnosis->more = true;

  ask_otherwise(path, 1);
  EXPECT_EQ(best.at_once, 1) << "only one may be added";
  EXPECT_EQ(best.refused, std::vector{number_of("ring")}) << "the last that was tried";
  best.refused.clear();

  ask_otherwise(path, 2);
  EXPECT_EQ(best.at_once, 2);
  EXPECT_TRUE(best.refused.empty()) << "both together may be confirmed";
  ask_otherwise(path, 2);
  EXPECT_EQ(best.at_once, 1) << "neither were both";
  EXPECT_EQ(best.refused, std::vector{number_of("ring")});

  best.diagnosis->more = false;
  ask_otherwise(path, 2);
  EXPECT_EQ(best.at_once, 1) << "nothing else stands out";
}

TEST(Explanation, OfSeveralAtOnceWhatAllPromisedIsAsked) {
  Finding spring = effect("spring", Role::accepted, 3), ring = effect("ring", Role::accepted, 2);
  spring.held_out_gain = Gain{.value = 0.1};
  ring.held_out_gain = Gain{.value = 0.6};
  Diagnosis made = diagnosis(Verdict::missing, {spring, ring});
  made.held_out = Gain{.value = 0.5};
  ExplanationPath path;
  path.models = {model(0, made, {}), model(1, std::nullopt, {spring, ring})};
  path.best = 1;
  path.models[1].told.gain = Gain{.value = 0.45};
  EXPECT_TRUE(is_settled(path));
  path.models[1].told.gain = Gain{.value = 0.35};
  EXPECT_FALSE(is_settled(path)) << "less than was foreseen";
}

/// What each diagnosis asks for anew, since no model takes it up, is told once, as it is in the end.
TEST(Explanation, TellsOnceWhatEachDiagnosisFinds) {
  const auto mesh = [](double share) { return finding("coarse_mesh", CandidateKind::numerics, Role::accepted, share); };
  ExplanationPath path;
  path.models = {model(0, diagnosis(Verdict::missing, {effect("contact", Role::accepted, 1), mesh(0.4)}), {}),
                 model(1, diagnosis(Verdict::missing, {mesh(0.5)}), {effect("contact", Role::accepted, 7)})};
  path.best = 1;
  EXPECT_EQ(said_of(path).front(),
            "MISSING: contact at spine, factor 7 (3.5 .. 14); and THE NUMERICS are too coarse: coarse_mesh at spine, "
            "factor 0.5 (0.25 .. 1)");
}

/// What a later diagnosis could not tell apart, and was not confirmed, takes nothing from what was found before.
TEST(Explanation, KeepsWhatIsSureIfTheNextIsNotConfirmed) {
  ExplanationPath path;
  path.models = {
      model(0, diagnosis(Verdict::missing, {effect("contact", Role::accepted, 1)}), {}),
      model(1, diagnosis(Verdict::ambiguous, {effect("spring", Role::accepted, 2), effect("ring", Role::rival, 3)}),
            {effect("contact", Role::accepted, 7)}),
      refused(2, "with spring at spine")};
  path.best = 1;
  EXPECT_EQ(verdict_of(path), Verdict::missing);
  EXPECT_EQ(said_of(path).front(), "MISSING: contact at spine, factor 7 (3.5 .. 14)");
  EXPECT_EQ(said_of(path).back(), "Tried and not kept: with spring at spine: held-out data do not confirm it");
}

/// Its own parameters are no effect that a diagnosis asked for.
TEST(Explanation, IsNotUndecidedSinceTheCasesOwnParametersGainNothing) {
  PathModel own = model(1, std::nullopt, {});
  own.told.name = "with its own parameters identified";
  own.told.accepted = false;
  own.told.objection = Objection::not_confirmed;
  ExplanationPath path;
  path.models = {model(0, diagnosis(Verdict::nothing_missing, {}), {}), own};
  EXPECT_EQ(path.refused_since_best(), 0U);
  EXPECT_EQ(verdict_of(path), Verdict::nothing_missing);
  EXPECT_TRUE(said_of(path).front().starts_with("NOTHING MISSING")) << said_of(path).front();
  path.models.push_back(refused(2, "with contact at spine"));
  EXPECT_EQ(path.refused_since_best(), 1U);
  EXPECT_EQ(verdict_of(path), Verdict::undecided);
}

TEST(Explanation, IsUndecidedIfNothingWasConfirmed) {
  ExplanationPath path;
  path.models = {
      model(0, diagnosis(Verdict::ambiguous, {effect("contact", Role::accepted, 1), effect("spring", Role::rival, 3)}),
            {}),
      refused(1, "with contact at spine")};
  EXPECT_EQ(verdict_of(path), Verdict::undecided);
  EXPECT_EQ(said_of(path).front(), "UNDECIDED: with contact at spine stands out, but held-out data do not confirm it");
}

/// What was found explains most; what its model leaves is no noise, and no candidate explains that.
TEST(Explanation, IsUndecidedWhereWhatWasFoundLeavesMoreThanNoise) {
  const auto path_that_leaves = [](double p) {
    Diagnosis last = diagnosis(Verdict::undecided, {});
    last.lack_of_fit.after.emplace().p = p;
    ExplanationPath path;
    path.models = {model(0, diagnosis(Verdict::undecided, {effect("tension", Role::accepted, 1)}), {}),
                   model(1, last, {effect("tension", Role::accepted, 7)})};
    path.best = 1;
    return path;
  };
  EXPECT_EQ(verdict_of(path_that_leaves(0.001)), Verdict::undecided);
  EXPECT_EQ(verdict_of(path_that_leaves(0.02)), Verdict::missing);
  const std::vector<std::string> said = said_of(path_that_leaves(0.001));
  EXPECT_TRUE(said.front().starts_with("UNDECIDED: ") && said.front().find("; beside tension") != std::string::npos)
      << said.front();
  EXPECT_TRUE(std::none_of(said.begin(), said.end(), [](const std::string& s) { return s.starts_with("Beside what"); }))
      << "which the first sentence has told";
}

/// The same of one diagnosis.
TEST(Diagnosis, NamesNoLawForSureThatLeavesMoreThanNoise) {
  Diagnosis open = diagnosis(Verdict::undecided, {effect("tension", Role::accepted, 1)});
  open.lack_of_fit.after.emplace().p = 0.001;
  const std::string said = headline_of(open);
  EXPECT_TRUE(said.starts_with("UNDECIDED: tension") &&
              said.ends_with("what that leaves is not noise: another law belongs in its place, or something beside it"))
      << said;
}

/// What is sure is not mixed with what is not, and what stood out last is not lost.
TEST(Explanation, TellsWhatIsSureBesideWhatIsNot) {
  Finding frame = finding("misplaced_frame", CandidateKind::data, Role::accepted, 2);
  frame.group.reset();
  frame.where = "ct, 0.3 s";
  frame.frame = 4;
  Finding contact = effect("contact", Role::accepted, 1), tissue = effect("tissue", Role::rival, 2);
  contact.misfit_removed = 9;
  tissue.rival = false;
  tissue.confirmed_by_runs = true;
  tissue.misfit_removed = 1;
  Diagnosis last = diagnosis(Verdict::undecided, {});
  last.path.push_back(
      {"loose_ring", {}, "", false, Objection::not_confirmed, reason_of(Objection::not_confirmed), 0, 0, {}});
  ExplanationPath path;
  path.models = {
      model(0, diagnosis(Verdict::ambiguous, {frame, contact, effect("spring", Role::rival, 3), tissue}), {}),
      model(1, last, {effect("contact", Role::accepted, 7)})};
  path.best = 1;
  const std::vector<std::string> said = said_of(path);
  EXPECT_EQ(
      said[0],
      "AMBIGUOUS: these data cannot tell contact at spine, factor 7 (3.5 .. 14) from spring at spine, factor about "
      "3; THE DATA are off: misplaced_frame at ct, 0.3 s, factor 2 (1 .. 4)");
  const auto holds = [&](const std::string& sentence) {
    return std::find(said.begin(), said.end(), sentence) != said.end();
  };
  EXPECT_TRUE(holds("Beside what was found: loose_ring stands out, but held-out data do not confirm it"));
  EXPECT_TRUE(
      holds("There is what does much the same as contact at spine: its runs remove 9 of the misfit, those of "
            "tissue at spine (8 less)"))
      << "of a diagnosis before the last";
  EXPECT_TRUE(holds("Wrong, and left out where values were found: misplaced_frame at ct, 0.3 s"));
}

TEST(Explanation, CallsAnErrorOfTheDataNoEffect) {
  ExplanationPath path;
  path.models = {
      model(0, diagnosis(Verdict::missing, {finding("misplaced_frame", CandidateKind::data, Role::accepted, 2)}), {})};
  EXPECT_EQ(verdict_of(path), Verdict::missing);
  EXPECT_EQ(said_of(path).front(),
            "THE DATA are off, the model lacks nothing beside: misplaced_frame at spine, factor 2 (1 .. 4)");
  path.models[0].diagnosis->corrected_case = "corrected.yaml";
  EXPECT_EQ(explanation_of(path).corrected_case, "diagnosis_0/corrected.yaml");
  EXPECT_EQ(said_of(path)[1], "Is it so? Then explain the case with these errors taken off the data");
  path.models = {model(0, diagnosis(Verdict::missing, {effect("contact", Role::accepted, 2)}), {}),
                 model(1, std::nullopt, {effect("contact", Role::accepted, 7)})};
  path.best = 1;
  EXPECT_EQ(said_of(path).front(), "MISSING: contact at spine, factor 7 (3.5 .. 14)");
}

}  // namespace explanation_test
}  // namespace tether
