/// Which parts of places are worth a run, on a linear system.
#include "diagnosis/search/division.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/diagnosis/band.hpp"

namespace tether {
namespace effect_search_test {

/// A spring and a stiffening in all of the spine, a damper that does something else, and the stiffening in its outlet
/// half, which leads.
class PartsOfASpine : public ::testing::Test {
 protected:
  PartsOfASpine() {
    place("visco_elastic", "stiffness", response(0, 12, beat), {});
    place("stiffening", "cubic", response(0, 12, [](int m) { return beat(m) * beat(m); }), {});
    place("damper", "damping", response(0, 12, [](int m) { return std::sin(2 * std::numbers::pi * m / moments); }), {});
    place("stiffening", "cubic", response(0, 2.5, [](int m) { return beat(m) * beat(m); }), outlet);
    problem_.residual = 5 * problem_.changes.rightCols(1);
    for (const Extent& extent : {inlet, outlet})
      for (const auto& [type, number] : std::map<std::string, std::string>{
               {"visco_elastic", "stiffness"}, {"stiffening", "cubic"}, {"damper", "damping"}}) {
        const std::string path = "solid.effects." + type + (extent == inlet ? "_inlet" : "_outlet");
        effects_.push_back({path, type, "spine", "", true, {}, {}, extent, "cm"});
        numbers_.push_back({{path + "." + number, "", "1", ""}, 1});
      }
  }

  void place(const std::string& type, const std::string& number, const VectorXd& change, const Extent& extent) {
    add_candidate(problem_, type, change);
    Candidate& added = problem_.candidates.back();
    added.type = type, added.part = "spine", added.number = number, added.extent = extent;
  }

  const Extent inlet{0, 0.5}, outlet{0.5, 1};
  EffectProblem problem_ = band();
  std::vector<PlacedEffect> effects_;
  std::vector<VariedNumber> numbers_;
};

/// The spring is improbable as a whole, and looks little like the half that leads: in no group with it. Its half may be
/// what leads, and is run. Nothing is asked of what does something else, and each is asked for once.
TEST_F(PartsOfASpine, AreAskedForOfWhatDoesTheSameInAllOfIt) {
  const SetEvidence evidence(problem_, {});
  const std::size_t half = problem_.candidates.size() - 1, spring = half - 3, damper = half - 1;
  ASSERT_GT(std::pow(evidence.cosine(half - 2, spring), 2), 0.5);
  ASSERT_LT(std::pow(evidence.cosine(half, spring), 2), 0.5) << "in one group with it, it would be asked for anyway";
  ASSERT_LT(std::pow(evidence.cosine(half - 2, damper), 2), 0.5);

  Division division(effects_, numbers_);
  EXPECT_TRUE(division.undivided().empty());
  Weighed weighed;
  weighed.groups.push_back({0.99, 0.99, {half}, {1.0}, {5.0}, {true}, {}, {}});
  const auto names = [&] {
    std::vector<std::string> all;
    for (const VariedNumber& number : division.next(problem_, weighed, evidence)) all.push_back(number.number.name);
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(names(), (std::vector<std::string>{"solid.effects.stiffening_outlet.cubic",
                                               "solid.effects.visco_elastic_outlet.stiffness"}));
  EXPECT_TRUE(names().empty());
}

TEST_F(PartsOfASpine, AreAskedForOfWhatLeadsInAllOfIt) {
  Division division(effects_, numbers_);
  Weighed weighed;
  weighed.groups.push_back({0.99, 0.99, {problem_.candidates.size() - 4}, {1.0}, {5.0}, {true}, {}, {}});
  EXPECT_EQ(division.next(problem_, weighed, SetEvidence(problem_, {})).size(), 2U);
}

/// Of the whole wall either end is asked for from the start, what lies between them once an end leads.
TEST_F(PartsOfASpine, AreAskedForBetweenTheEndsOfAVesselWhereOneLeads) {
  effects_.clear(), numbers_.clear();
  for (const Extent& extent : {inlet, outlet, Extent{0.25, 0.75}}) {
    const std::string path = "solid.effects.stiffness_factor_" + in_words(extent, "cm").substr(0, 6);
    effects_.push_back({path, "stiffness_factor", "", "", true, {}, {}, extent, "cm"});
    numbers_.push_back({{path + ".factor", "", "1", ""}, 1});
  }
  add_candidate(problem_, "stiffness_factor", response(0, 2.5, beat));
  Candidate& end = problem_.candidates.back();
  end.type = "stiffness_factor", end.number = "factor", end.extent = outlet;
  Division division(effects_, numbers_);
  EXPECT_EQ(division.undivided().size(), 2U);
  Weighed weighed;
  weighed.groups.push_back({0.99, 0.99, {problem_.candidates.size() - 1}, {1.0}, {5.0}, {true}, {}, {}});
  const std::vector<VariedNumber> next = division.next(problem_, weighed, SetEvidence(problem_, {}));
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next.front().number.name, "solid.effects.stiffness_factor_middle.factor");
}

}  // namespace effect_search_test
}  // namespace tether
