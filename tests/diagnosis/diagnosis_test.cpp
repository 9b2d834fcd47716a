/// A whole diagnosis without processes: from a case with measured surfaces and runs of a fake to what the model lacks.
#include "diagnosis/search/diagnosis.hpp"

#include <gtest/gtest.h>

#include <map>

#include "diagnosis/search/published_models.hpp"
#include "tests/diagnosis/fake_runs.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/surface_file.hpp"

namespace tether::testing {
namespace diagnosis_test {

constexpr const char* tube = R"(name: tube
units: cgs
time: {step: 0.02, end: 0.8}
mesh:
  source: swept
  swept: {radius: 2, length: 10, wall_thickness: 0.2, around: 24, along: 16, layers: 1,
          regions: {spine: {angle: [120, 240]}, left: {angle: [0, 120]}, right: {}}}
)";
constexpr const char* measured =
    "observations: {surfaces: {ct: {file: ct.csv, unit: cm, held_out: [2, 5], noise: {deviation: 0.1 mm, "
    "correlation_length: 5 mm}}}}\n";

const std::vector<std::string> regions{"spine", "left", "right"};

/// A case that was measured: the truth has a spring of 0.8 at the spine, or in a half of it.
std::filesystem::path written_in(const TemporaryFolder& folder, const std::string& hidden = "spine") {
  CaseFile file(folder.file("tube.yaml", tube));
  MeshCase mesh;
  file.read("mesh", mesh);
  const LumenSurface lumen = lumen_of(load_mesh(mesh, file, WallElement::prism));
  const FakeRuns truth(lumen, regions);
  std::string list = "file, time [s]\n";
  for (int frame = 0; frame < 8; ++frame) {
    const std::string name = fmt::format("s{}.stl", frame);
    write_stl(folder / name, truth.at(0.1 * frame, {{"solid.effects.spring_" + hidden + ".stiffness"}, {0.8}}),
              lumen.triangles);
    list += fmt::format("{}, {}\n", name, 0.1 * frame);
  }
  folder.file("ct.csv", list);
  return folder.file("case.yaml", std::string(tube) + measured);
}

class WholeDiagnosis : public ::testing::Test {
 public:
  static std::vector<PlacedEffect> effects() {
    std::vector<PlacedEffect> all;
    for (const std::string& region : regions)
      all.push_back({"solid.effects.spring_" + region, "spring", region, "holds the wall back", true, {}});
    for (const std::string& region : regions)
      for (const auto& [half, extent] : std::map<std::string, Extent>{
               {"_inlet_half", {0, 0.5}}, {"_outlet_half", {0.5, 1}}, {"_middle_half", {0.25, 0.75}}}) {
        all.push_back(
            {"solid.effects.spring_" + region + half, "spring", region, "holds it there", true, {}, {}, extent});
      }
    return all;
  }

 protected:
  DiagnosisReport report(const DiagnosisSettings& settings = {}) {
    return diagnose(given, effects(), {runs}, settings);
  }
  int trials() const {
    return static_cast<int>(std::count_if(runs.made.begin(), runs.made.end(),
                                          [](const std::string& folder) { return folder.starts_with("trials/"); }));
  }

  TemporaryFolder folder;
  DiagnosedCase given{written_in(folder)};
  FakeRuns runs{given.lumen, regions};
};

TEST_F(WholeDiagnosis, FindsTheHiddenSpringAndItsStiffness) {
  const DiagnosisReport found = report();
  EXPECT_EQ(found.found.verdict, Verdict::missing);
  const TestedEffect& first = found.found.effects.front();
  EXPECT_TRUE(first.accepted);
  const Candidate& candidate = found.problem.candidates[first.candidate];
  EXPECT_EQ(candidate.name, "spring");
  EXPECT_EQ(candidate.where, "spine");
  EXPECT_NEAR(first.amplitudes(0), 0.8, 0.02);
  EXPECT_EQ(found.cost.sensitivity_runs, 7) << "the model as it is, each spring, and parts of that which leads";
  EXPECT_EQ(found.cost.runs, 7 + trials());
  EXPECT_GE(trials(), 1);
  EXPECT_LE(trials(), 4) << "a linear model is known after two of each";
}

/// The volume's strain falls by 5 % a unit of spring.
TEST_F(WholeDiagnosis, SaysWhatItChangesInPublishedQuantities) {
  const DiagnosisReport found = report();
  const FoundValue stiffness = value_of(found.problem, found.found.effects.front(), 0);
  ASSERT_EQ(found.published.size(), 2U);
  EXPECT_EQ(found.published[0].model, ModelRole::as_it_is);
  const QuantityFound before = found.published[0].quantities.at(0), after = found.published[1].quantities.at(0);
  EXPECT_EQ(before.quantity, Quantity::strain);
  EXPECT_NEAR(before.value, 20, 1e-9);
  EXPECT_FALSE(before.lower.has_value());
  EXPECT_EQ(found.published[1].model, ModelRole::accepted);
  EXPECT_EQ(found.published[1].effects.size(), 1U);
  EXPECT_NEAR(after.value, 20 - 5 * stiffness.value, 1e-9);
  EXPECT_NEAR(after.lower.value(), 20 - 5 * stiffness.upper, 1e-6);
  EXPECT_NEAR(after.upper.value(), 20 - 5 * stiffness.lower, 1e-6);
}

/// Of an amplitude that falls in powers of two, more of it is a smaller value.
TEST(FoundValue, LiesBetweenItsEndsWhereTheAmplitudeIsNegative) {
  EffectProblem problem;
  problem.amplitudes.push_back({"factor", "factor", "1", false, 1.0, 1, true});
  Candidate softer;
  softer.amplitudes = {0};
  problem.candidates.push_back(softer);
  TestedEffect effect;
  effect.confirmed = true;
  effect.amplitudes = VectorXd::Constant(1, -1.0);
  effect.deviations = VectorXd::Constant(1, 0.1);
  effect.intervals = {AmplitudeInterval{-1.2, -1, -0.9}};
  const FoundValue found = value_of(problem, effect, 0);
  EXPECT_NEAR(found.value, 0.5, 1e-12);
  EXPECT_NEAR(found.lower, std::pow(2, -1.2), 1e-12);
  EXPECT_NEAR(found.upper, std::pow(2, -0.9), 1e-12);
  effect.intervals = {AmplitudeInterval{-0.8, -0.7, -0.6}};
  const FoundValue outside = value_of(problem, effect, 0);
  EXPECT_NEAR(outside.lower, std::pow(2, -1.196), 1e-4) << "runs found it where the table does not have it";
  EXPECT_NEAR(outside.upper, std::pow(2, -0.6), 1e-12);
}

/// A rival of the first of two is shown beside the second, as what was accepted is: a run of both is made.
TEST_F(WholeDiagnosis, SaysWhatARivalChangesBesideWhatElseWasAccepted) {
  DiagnosisReport found = report();
  const FinishedMotion base = runs.make({base_run()}).front();
  const Evidence evidence(given.data, given.lumen, base);
  const Whitening whitening(evidence, evidence.problem());
  Trials trials(found.problem, evidence, whitening, base, runs);
  const auto at = [&](const std::string& part, bool whole) {
    const auto& all = found.problem.candidates;
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(),
                     [&](const Candidate& c) { return c.part == part && c.extent.is_all() == whole; }) -
        all.begin());
  };
  const auto effect_of = [&](std::size_t candidate, double amplitude, VectorXd run) {
    TestedEffect effect = found.found.effects.front();
    effect.candidate = candidate;
    effect.amplitudes = VectorXd::Constant(1, amplitude);
    run(found.problem.candidates.at(candidate).amplitudes.front()) = amplitude;
    effect.run = run;
    effect.intervals.clear();
    trials.residual_at(run);
    return effect;
  };
  const VectorXd none = VectorXd::Zero(found.problem.changes.cols());
  TestedEffect first = effect_of(at("spine", true), 0.8, none), second = effect_of(at("left", true), 0.5, first.run),
               rival = effect_of(at("spine", false), 1.2, none);
  second.group = first.group + 1;
  rival.accepted = false;
  rival.rival = true;
  found.found.effects = {first, second, rival};
  const auto models = published_models(given, evidence, found, trials, base, runs);
  ASSERT_EQ(models.size(), 3U);
  EXPECT_NEAR(models[1].quantities.at(0).value, 20 - 5 * (0.8 + 0.5), 1e-9);
  EXPECT_EQ(models[2].effects.size(), 2U);
  EXPECT_NEAR(models[2].quantities.at(0).value, 20 - 5 * (1.2 + 0.5), 1e-9);
  EXPECT_LT(models[2].quantities.at(0).lower.value(), 20 - 5 * (1.2 + 0.5));
}

/// What the mesh does is asked of a finer one where none can be coarser.
TEST_F(WholeDiagnosis, AsksAFinerMeshWhereNoneIsCoarser) {
  EXPECT_FALSE(given.asks_numerics()) << "24 x 16: half of it is a mesh too";
  const auto asks = [&](const std::string& more) {
    return DiagnosedCase(folder.file("more.yaml", "base: case.yaml\nname: more\n" + more)).asks_numerics();
  };
  const std::string coarse = "mesh: {swept: {around: 12, along: 8}}\n";
  EXPECT_TRUE(asks(coarse));
  EXPECT_TRUE(asks("mesh: {swept: {along: 8}}\n"));
  EXPECT_FALSE(asks(coarse + "diagnosis: {numerics: false}\n"));
  EXPECT_TRUE(asks("diagnosis: {numerics: true}\n"));
}

TEST_F(WholeDiagnosis, AsksForNothingThatIsExcluded) {
  auto placed = effects();
  placed.front().is_new = false;  // the case has it, switched off
  const auto numbers = [&](const std::vector<std::string>& words) {
    DiagnosisCase wanted;
    wanted.exclude = words;
    std::vector<std::string> names;
    for (const VariedNumber& one : varied_numbers(runs.parameters(), placed, wanted, given.file))
      names.push_back(one.number.name);
    return names;
  };
  const std::string spring = "solid.effects.spring_spine.stiffness";
  EXPECT_EQ(numbers({}).size(), 12U);
  for (const char* word : {"spring", "spine", spring.c_str()}) {
    const auto left = numbers({word});
    EXPECT_EQ(std::count(left.begin(), left.end(), spring), 0) << word;
  }
  EXPECT_EQ(numbers({"left"}).size(), 8U) << "and its parts";
  runs.infos.front().value = 0.5;
  const auto left = numbers({"spine"});
  EXPECT_EQ(std::count(left.begin(), left.end(), spring), 1) << "the model has it: how much is its own number";
}

/// A unit of spring holds a third of the lumen back by half a millimetre.
TEST_F(WholeDiagnosis, SaysHowFarItMovesTheLumen) {
  const DiagnosisReport found = report();
  const FoundValue stiffness = value_of(found.problem, found.found.effects.front(), 0);
  ASSERT_EQ(found.published.size(), 2U);
  EXPECT_EQ(found.published[0].quantities.at(1).value, 0);
  const QuantityFound moved = found.published[1].quantities.at(1);
  EXPECT_EQ(moved.quantity, Quantity::displacement);
  EXPECT_EQ(moved.unit, "mm");
  EXPECT_NEAR(moved.value, 0.5 * stiffness.value * std::sqrt(1.0 / 3), 0.04 * moved.value);
  EXPECT_NEAR(moved.upper.value() / moved.value, stiffness.upper / stiffness.value, 1e-6);
}

TEST_F(WholeDiagnosis, SaysNothingOfItWhereNothingIsAccepted) {
  EXPECT_TRUE(report({.refused = {runs.infos[0].name}}).published.empty());
}

TEST_F(WholeDiagnosis, WhatWasRefusedIsNotAcceptedAgain) {
  const DiagnosisReport found = report({.refused = {runs.infos[0].name}});
  EXPECT_FALSE(found.found.effects.front().accepted);
  EXPECT_NE(found.found.verdict, Verdict::missing);
}

TEST_F(WholeDiagnosis, ARunThatFailsIsLeftOut) {
  runs.fails = {"candidates/runs/" + runs.infos[1].name};
  const DiagnosisReport found = report();
  EXPECT_EQ(found.found.verdict, Verdict::missing);
  EXPECT_EQ(found.problem.candidates[found.found.effects.front().candidate].where, "spine");
  for (const Candidate& candidate : found.problem.candidates) EXPECT_NE(candidate.where, "left");
}

TEST_F(WholeDiagnosis, WithoutTheModelAsItIsThereIsNone) {
  runs.fails = {"candidates/runs/base"};
  EXPECT_EQ(message_of([&] { report(); }), "the model as it is: too much");
  EXPECT_EQ(runs.made.size(), 1U);
}

/// Parts of places are run where something is probable, and only there.
TEST(Diagnosis, SaysInWhichPartOfItsPlaceAnEffectActs) {
  for (const std::string half : {"outlet half", "middle half"}) {
    const TemporaryFolder folder;
    const DiagnosedCase given(written_in(folder, "spine_" + half.substr(0, 6) + "_half"));
    FakeRuns runs(given.lumen, regions);
    const DiagnosisReport found = diagnose(given, WholeDiagnosis::effects(), {runs});
    EXPECT_EQ(found.found.verdict, Verdict::missing);
    const TestedEffect& first = found.found.effects.front();
    EXPECT_EQ(found.problem.candidates[first.candidate].where, "spine, " + half);
    EXPECT_NEAR(first.amplitudes(0), 0.8, 0.03);
    for (const std::string& run : runs.made) EXPECT_EQ(run.find("left_"), std::string::npos) << run;
  }
}

/// Across the border of two regions, where no effect of the catalogue acts.
TEST(Diagnosis, SaysWhereAMisfitIsThatNoRegionHolds) {
  const TemporaryFolder folder;
  const DiagnosedCase given(written_in(folder, "dent"));
  FakeRuns runs(given.lumen, regions);
  const DiagnosisReport found = diagnose(given, WholeDiagnosis::effects(), {runs});
  ASSERT_TRUE(found.located.before.has_value());
  const LocatedMisfit& dent = *found.located.before;
  const double element = 0.65;
  EXPECT_LT((dent.centre - FakeRuns::dent).norm(), element);
  EXPECT_LT(dent.p, 1e-6);
  EXPECT_LT(dent.resolution, 2 * element);
  EXPECT_GT(dent.resolution, element / 2) << "no better than the places that were tried";
  EXPECT_NEAR(dent.amount, -0.04, 0.015) << "four fifths of half a millimetre";
  EXPECT_NEAR(dent.time, 0.4, 0.11);
  EXPECT_EQ(dent.unit, "cm");
  ASSERT_EQ(dent.regions.size(), 2U);
  EXPECT_NEAR(dent.regions[0].share + dent.regions[1].share, 1, 0.1);
  EXPECT_EQ(found.misfit_map.size(), given.lumen.points.cols());
}

/// The patch is found, with its size and the law's number, though the search begins with regions.
TEST(Diagnosis, FindsTheEffectOnAPatchAcrossRegions) {
  const TemporaryFolder folder;
  const DiagnosedCase given(written_in(folder, "disc"));
  FakeRuns runs(given.lumen, regions);
  const auto extend = [&](const std::vector<PlacedEffect>& more) { runs.add(more); };
  const DiagnosisReport found = diagnose(given, WholeDiagnosis::effects(), {runs, nullptr, {}, extend});
  EXPECT_EQ(found.found.verdict, Verdict::missing);
  const TestedEffect& first = found.found.effects.front();
  ASSERT_TRUE(first.accepted);
  const Candidate& patch = found.problem.candidates[first.candidate];
  ASSERT_TRUE(patch.extent.about.has_value()) << patch.where;
  const double element = 0.65;
  EXPECT_LT((patch.extent.about->centre - FakeRuns::dent).norm(), element);
  EXPECT_NEAR(patch.extent.about->radius, 1, 0.35);
  EXPECT_NEAR(first.amplitudes(0) * std::pow(patch.extent.about->radius, 2), 0.8, 0.3)
      << "centres are nodes': two discs half an element apart have three quarters in common";
  EXPECT_TRUE(patch.where.starts_with("the wall within ")) << patch.where;
  EXPECT_LT(runs.patches.size(), 40U);
  ASSERT_TRUE(found.patch.has_value());
  EXPECT_EQ(found.patch->patch, *patch.extent.about);
  EXPECT_LE(found.patch->known_to, 2 * element);
  EXPECT_LE(found.patch->least_radius, found.patch->patch.radius);
  EXPECT_GE(found.patch->largest_radius, found.patch->patch.radius);
  std::vector<std::string> elsewhere;
  for (const TestedEffect& effect : found.found.effects)
    if (const Candidate& named = found.problem.candidates[effect.candidate];
        (effect.accepted || effect.rival) && !named.extent.about)
      elsewhere.push_back(named.where);
  EXPECT_EQ(elsewhere, std::vector<std::string>{});
}

TEST(Diagnosis, LooksForNoPatchWhereARegionExplainsTheData) {
  const TemporaryFolder folder;
  const DiagnosedCase given(written_in(folder, "left"));
  FakeRuns runs(given.lumen, regions);
  const auto extend = [&](const std::vector<PlacedEffect>& more) { runs.add(more); };
  const DiagnosisReport found = diagnose(given, WholeDiagnosis::effects(), {runs, nullptr, {}, extend});
  EXPECT_EQ(found.problem.candidates[found.found.effects.front().candidate].where, "left");
  EXPECT_TRUE(runs.patches.empty());
}

TEST(Diagnosis, LocatesNothingWhereNothingIsOff) {
  const TemporaryFolder folder;
  const DiagnosedCase given(written_in(folder, "nowhere"));
  FakeRuns runs(given.lumen, regions);
  const DiagnosisReport found = diagnose(given, WholeDiagnosis::effects(), {runs});
  ASSERT_TRUE(found.located.before.has_value() && found.located.after.has_value());
  EXPECT_GT(found.located.before->p, 0.5);
  EXPECT_GT(found.located.after->p, 0.5);
}

/// A coarser model tells what numbers do to first order; what is named is run with the model, and has its amplitude.
TEST_F(WholeDiagnosis, NeedsTheModelItselfOnlyForWhatIsProbable) {
  FakeRuns coarse(given.lumen, regions);
  coarse.strength = 0.8;
  const DiagnosisReport found = diagnose(given, effects(), {runs, &coarse});
  EXPECT_EQ(found.found.verdict, Verdict::missing);
  const TestedEffect& first = found.found.effects.front();
  EXPECT_EQ(found.problem.candidates[first.candidate].where, "spine");
  EXPECT_NEAR(first.amplitudes(0), 0.8, 0.02);
  EXPECT_GE(coarse.made.size(), 4U);
  EXPECT_EQ(found.cost.coarse_runs, static_cast<int>(coarse.made.size()));
  EXPECT_EQ(runs.made.front(), "candidates/runs/base");
  EXPECT_EQ(static_cast<int>(runs.made.size()), 1 + trials());
  EXPECT_LE(trials(), 4);
}

/// What leads is run with a finer mesh too, once: so much as that changes in it, its amplitude may be off.
TEST_F(WholeDiagnosis, AsksAFinerMeshWhatItChangesInWhatLeads) {
  const auto found_with = [&](FakeRuns& finer) {
    FakeRuns own(given.lumen, regions);
    return diagnose(given, effects(),
                    {own, nullptr, {{{"coarse_mesh", "share", {}, true}, finer.motion({}), &finer, true}}});
  };
  const auto width = [](const DiagnosisReport& report) {
    const TestedEffect& first = report.found.effects.front();
    EXPECT_TRUE(first.accepted);
    EXPECT_EQ(report.problem.candidates[first.candidate].where, "spine");
    return first.intervals.front()->most - first.intervals.front()->least;
  };
  FakeRuns alike(given.lumen, regions), stiffer(given.lumen, regions), failing(given.lumen, regions);
  stiffer.strength = 1.3;
  failing.fails = {"trials/runs/trial_001", "trials/runs/trial_002", "trials/runs/trial_003"};
  const double known = width(found_with(alike)), wider = width(found_with(stiffer)),
               unknown = width(found_with(failing));
  EXPECT_GT(wider, 2 * known);
  EXPECT_DOUBLE_EQ(unknown, known) << "a run that fails tells nothing, and is not asked for again";
  for (const FakeRuns* finer : {&alike, &stiffer, &failing}) {
    EXPECT_FALSE(finer->made.empty());
    EXPECT_EQ(std::set<std::string>(finer->made.begin(), finer->made.end()).size(), finer->made.size());
    EXPECT_LE(finer->made.size(), 3U);
  }
}

}  // namespace diagnosis_test
}  // namespace tether::testing
