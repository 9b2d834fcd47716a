#include "tether/explanation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
          {"amplitude",
           {{"parameter", "solid.effects." + name + ".factor"},
            {"value", value},
            {"lower", value / 2},
            {"upper", value * 2},
            {"unit", "1"}}}};
}

Json diagnosis(const std::string& verdict, const Json& effects) {
  return {
      {"verdict", verdict}, {"sentences", {verdict + " it says"}}, {"effects", effects}, {"detectable", Json::array()}};
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
  EXPECT_EQ(sentences_of(e).front(),
            "AMBIGUOUS: these data cannot tell contact at spine, factor 7 (3.5 .. 14) from spring at spine, factor 3 "
            "(1.5 .. 6)");
  e.models.push_back(model(2, nullptr, Json::array({effect("loose_ring", "effect", true, false, 5)})));
  e.best = 2;
  EXPECT_TRUE(sentences_of(e).front().ends_with("; beside it loose_ring at spine, factor 5 (2.5 .. 10)"));
}

TEST(Explanation, CallsAnErrorOfTheDataNoEffect) {
  Explanation e;
  e.models = {
      model(0, diagnosis("missing", Json::array({effect("misplaced_frame", "data", true, false, 2)})), Json::array())};
  EXPECT_EQ(verdict_of(e), "missing");
  EXPECT_EQ(sentences_of(e).front(), "missing it says") << "the diagnosis's own sentence: the data are off";
  e.models = {model(0, diagnosis("missing", Json::array({effect("contact", "effect", true, false, 2)})), Json::array()),
              model(1, nullptr, Json::array({effect("contact", "effect", true, false, 7)}))};
  e.best = 1;
  EXPECT_EQ(sentences_of(e).front(), "MISSING: contact at spine, factor 7 (3.5 .. 14)");
}

}  // namespace
}  // namespace tether
