#include "tether/explanation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tether/corrected_data.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

Json effect(const std::string& name, const std::string& kind, bool accepted, bool rival, double value) {
  return {{"name", name},
          {"parameter", nullptr},
          {"where", "spine"},
          {"kind", kind},
          {"accepted", accepted},
          {"rival", rival},
          {"group", accepted || rival ? Json("1") : Json()},
          {"frame", nullptr},
          {"amplitude",
           {{"parameter", "solid.effects." + name + ".factor"},
            {"value", value},
            {"lower", value / 2},
            {"upper", value * 2},
            {"unit", "1"}}}};
}

Json diagnosis(const std::string& verdict, const Json& effects) {
  return {{"verdict", verdict},
          {"sentences", {verdict + " it says"}},
          {"effects", effects},
          {"detectable", Json::array()},
          {"corrected_case", nullptr}};
}

ExplainedModel model(int number, const Json& diagnosed, const Json& added) {
  ExplainedModel made;
  made.number = number;
  made.diagnosis = diagnosed.dump();
  made.added = added.dump();
  return made;
}

TEST(Explanation, SaysWhatWasIdentifiedOfWhatCannotBeToldApart) {
  Explanation e;
  const Json both = {effect("contact", "effect", true, false, 1), effect("spring", "effect", false, true, 3)};
  e.models = {model(0, diagnosis("ambiguous", both), Json::array()),
              model(1, nullptr, Json::array({effect("contact", "effect", true, false, 7)}))};
  e.best = 1;
  EXPECT_EQ(verdict_of(e), "ambiguous");
  EXPECT_EQ(
      sentences_of(e).front(),
      "AMBIGUOUS: these data cannot tell contact at spine, factor 7 (3.5 .. 14) from spring at spine, factor about "
      "3");
  e.models.push_back(model(2, nullptr, Json::array({effect("loose_ring", "effect", true, false, 5)})));
  e.best = 2;
  EXPECT_TRUE(sentences_of(e).front().ends_with("; beside it loose_ring at spine, factor 5 (2.5 .. 10)"));
}

/// What a later diagnosis could not tell apart, and was not confirmed, takes nothing from what was found before.
TEST(Explanation, KeepsWhatIsSureIfTheNextIsNotConfirmed) {
  Explanation e;
  const Json contact = effect("contact", "effect", true, false, 1), spring = effect("spring", "effect", true, false, 2),
             ring = effect("ring", "effect", false, true, 3);
  e.models = {
      model(0, diagnosis("missing", Json::array({contact})), Json::array()),
      model(1, diagnosis("ambiguous", {spring, ring}), Json::array({effect("contact", "effect", true, false, 7)})),
      model(2, nullptr, Json::array())};
  e.models[2].name = "with spring at spine";
  e.models[2].reason = "held-out frames do not confirm it";
  e.best = 1;
  EXPECT_EQ(verdict_of(e), "missing");
  EXPECT_EQ(sentences_of(e).front(), "MISSING: contact at spine, factor 7 (3.5 .. 14)");
  EXPECT_EQ(sentences_of(e).back(), "Tried and not kept: with spring at spine: held-out frames do not confirm it");
}

TEST(Explanation, IsUndecidedIfNothingWasConfirmed) {
  Explanation e;
  const Json both = {effect("contact", "effect", true, false, 1), effect("spring", "effect", false, true, 3)};
  e.models = {model(0, diagnosis("ambiguous", both), Json::array()), model(1, nullptr, Json::array())};
  e.models[1].name = "with contact at spine";
  e.models[1].reason = "held-out frames do not confirm it";
  EXPECT_EQ(verdict_of(e), "undecided");
  EXPECT_EQ(sentences_of(e).front(),
            "UNDECIDED: with contact at spine stands out, but held-out frames do not confirm it");
}

/// What is sure is not mixed with what is not, and what stood out last is not lost.
TEST(Explanation, TellsWhatIsSureBesideWhatIsNot) {
  Explanation e;
  Json frame = effect("misplaced_frame", "data", true, false, 2);
  frame["group"] = nullptr;
  frame["where"] = "ct, 0.3 s";
  frame["frame"] = 4;
  const Json contact = effect("contact", "effect", true, false, 1), spring = effect("spring", "effect", false, true, 3);
  Json last = diagnosis("undecided", Json::array());
  last["sentences"] = {"UNDECIDED: loose_ring stands out, but held-out data do not confirm it"};
  Json first = diagnosis("ambiguous", {frame, contact, spring});
  const std::string alike =
      std::string(much_like) + "contact at spine: its runs remove 9 of the misfit, those of tissue (8 less)";
  first["sentences"] = {"ambiguous", alike};
  e.models = {model(0, first, Json::array()),
              model(1, last, Json::array({effect("contact", "effect", true, false, 7)}))};
  e.best = 1;
  const std::vector<std::string> said = sentences_of(e);
  EXPECT_EQ(
      said[0],
      "AMBIGUOUS: these data cannot tell contact at spine, factor 7 (3.5 .. 14) from spring at spine, factor about "
      "3; THE DATA are off: misplaced_frame at ct, 0.3 s, factor 2 (1 .. 4)");
  const auto holds = [&](const std::string& sentence) {
    return std::find(said.begin(), said.end(), sentence) != said.end();
  };
  EXPECT_TRUE(holds("Beside what was found: loose_ring stands out, but held-out data do not confirm it"));
  EXPECT_TRUE(holds(alike)) << "of a diagnosis before the last";
  EXPECT_TRUE(holds("Wrong, and left out where values were found: misplaced_frame at ct, 0.3 s"));
}

TEST(Explanation, CallsAnErrorOfTheDataNoEffect) {
  Explanation e;
  e.models = {
      model(0, diagnosis("missing", Json::array({effect("misplaced_frame", "data", true, false, 2)})), Json::array())};
  EXPECT_EQ(verdict_of(e), "missing");
  EXPECT_EQ(sentences_of(e).front(), "missing it says") << "the diagnosis's own sentence: the data are off";
  Json with_correction = Json::parse(e.models[0].diagnosis);
  with_correction["corrected_case"] = "corrected.yaml";
  e.models[0].diagnosis = with_correction.dump();
  EXPECT_EQ(corrected_case(e), "diagnosis_0/corrected.yaml");
  EXPECT_TRUE(sentences_of(e)[1].ends_with("tether explain diagnosis_0/corrected.yaml")) << sentences_of(e)[1];
  e.models = {model(0, diagnosis("missing", Json::array({effect("contact", "effect", true, false, 2)})), Json::array()),
              model(1, nullptr, Json::array({effect("contact", "effect", true, false, 7)}))};
  e.best = 1;
  EXPECT_EQ(sentences_of(e).front(), "MISSING: contact at spine, factor 7 (3.5 .. 14)");
}

/// What the case says of the data already stays.
TEST(CorrectedData, AreWhatTheDiagnosisAsksFor) {
  ObservationsCase observations;
  observations.surfaces.emplace_back("ct", SurfacesCase{});
  LumenDataCase& ct = observations.surfaces[0].second.data;
  ct.correction.displacement = {0.5, 0, 0};
  ct.time_shift = 0.01;
  ct.left_out = {1};
  DiagnosisReport report;
  const auto accept = [&](const std::string& name, const std::vector<std::string>& axes, const VectorXd& amplitudes,
                          double frame = undefined) {
    Candidate error{name, "ct", "", Candidate::Kind::data, {}};
    error.data = {"observations.surfaces.ct", frame, Vec3(1, 2, 3)};
    for (const std::string& axis : axes) {
      error.amplitudes.push_back(static_cast<Eigen::Index>(report.problem.amplitudes.size()));
      report.problem.amplitudes.push_back({axis, "", "cm"});
    }
    TestedEffect effect;
    effect.candidate = report.problem.candidates.size();
    effect.amplitudes = amplitudes;
    effect.accepted = true;
    report.problem.candidates.push_back(error);
    report.found.effects.push_back(effect);
  };
  accept("misregistration", {"x", "y", "z"}, Vec3(0.25, -0.5, 0));
  accept("misrotation", {"about_x", "about_z"}, Eigen::Vector2d(0.125, 0.25));
  accept("segmentation_bias", {"bias"}, VectorXd::Constant(1, 0.0625));
  accept("gating_shift", {"time_shift"}, VectorXd::Constant(1, 0.03125));
  accept("misplaced_frame", {"x", "y", "z"}, Vec3(1, 0, 0), 4);
  accept("blur", {"variance"}, VectorXd::Constant(1, 0.1));
  std::map<std::string, std::string> said;
  for (const auto& [field, value] : corrections_of(report, observations))
    said[field.substr(std::string("observations.surfaces.ct.").size())] = value;
  EXPECT_EQ(said, (std::map<std::string, std::string>{{"correction.displacement", "[0.25, 0.5, 0]"},
                                                      {"correction.rotation", "[-0.125, 0, -0.25]"},
                                                      {"correction.about", "[0.5, 2, 3]"},
                                                      {"correction.outward", "-0.0625"},
                                                      {"time_shift", "0.04125"},
                                                      {"left_out", "[1, 4]"}}));
}

}  // namespace
}  // namespace tether
