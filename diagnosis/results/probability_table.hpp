#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"
#include "diagnosis/results/finding.hpp"
#include "diagnosis/results/phase_gain.hpp"

namespace tether {

/// What is assumed, and not known for sure.
enum class Assumed { sizes, noise, discrepancy };
template <>
inline constexpr auto words_of<Assumed> =
    std::to_array<WordOf<Assumed>>({{Assumed::sizes, "sizes", "how large effects and errors may be, beforehand"},
                                    {Assumed::noise, "noise", "its deviation"},
                                    {Assumed::discrepancy, "discrepancy", "how far the model itself may be off"}});

/// The table with something assumed otherwise.
struct AssumedOtherwise {
  static constexpr const char* type_name = "assumed_otherwise";
  Assumed what = Assumed::sizes;
  double factor = 1, nothing = 0;
  std::vector<double> groups;

  static void fields(auto& self, auto&& field) {
    field("what", self.what, "what is assumed");
    field("factor", self.factor, "times what it is taken for");
    field("nothing", self.nothing, "probability that the model lacks nothing, then");
    field("groups", self.groups, "probability of each group, then");
  }
};

/// One of several explanations that do much the same.
struct Alternative {
  static constexpr const char* type_name = "alternative";
  std::string name;
  std::optional<std::string> parameter;
  std::string where;
  CandidateKind kind = CandidateKind::effect;
  double share = 0;
  std::optional<double> value;
  std::string unit;
  bool by_runs = false;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect, input or error");
    field("parameter", self.parameter, "the only number of an effect that differs; null: all of them");
    field("where", self.where, "its place");
    field("kind", self.kind, "what it changes");
    field("share", self.share, "its probability within the group");
    field("value", self.value, "the most probable one of its number, in `unit`; null: it has several");
    field("unit", self.unit, "of the value; 1: none");
    field("by_runs", self.by_runs, "runs showed what it does at about that value");
  }
};

/// Explanations that do much the same: one of them.
struct AlternativeGroup {
  static constexpr const char* type_name = "alternative_group";
  double probability = 0, least_probability = 0;
  std::optional<PhaseGain> foretold;
  std::vector<Alternative> members;

  static void fields(auto& self, auto&& field) {
    field("probability", self.probability, "that it is one of them, whatever else");
    field("least_probability", self.least_probability, "the smallest of these, with any one thing assumed otherwise");
    field("foretold", self.foretold, "how much better each moment is foretold with it; null: not asked");
    field("members", self.members, "the most probable first");
  }
};

/// Groups that together explain the data.
struct Combination {
  static constexpr const char* type_name = "combination";
  std::vector<int> groups;
  double probability = 0;

  static void fields(auto& self, auto&& field) {
    field("groups", self.groups, "numbers of `groups`, from 0: one member of each, and no other");
    field("probability", self.probability, "of that");
  }
};

/// What the data say of all sets of candidates: `nothing`, `outside`, `others` and the combinations sum to 1. (D.19)
struct ProbabilityTable {
  static constexpr const char* type_name = "probability_table";
  double nothing = 0, outside = 0, others = 0, more = 0;
  std::vector<AlternativeGroup> groups;
  std::vector<Combination> combinations;
  std::vector<AssumedOtherwise> otherwise;

  static void fields(auto& self, auto&& field) {
    field("nothing", self.nothing, "probability that the model lacks nothing");
    field("outside", self.outside, "that something is missing, and no candidate is");
    field("others", self.others, "that it is what is too improbable to be listed");
    field("more", self.more, "that something outside of the catalogue is missing beside what is listed");
    field("groups", self.groups, "explanations that do much the same, the most probable group first");
    field("combinations", self.combinations, "what explains the data together, the most probable first");
    field("otherwise", self.otherwise, "nothing and the groups, with one thing at a time assumed otherwise");
  }
};

}  // namespace tether
