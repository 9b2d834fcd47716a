#pragma once

#include "diagnosis/results/verdict.hpp"
#include "twin/answer.hpp"

/// A diagnosis held against the sealed answer.
namespace tether {

struct ClaimedAmplitude {
  static constexpr const char* type_name = "claimed_amplitude";
  std::optional<double> value, lower, upper;
  std::optional<std::string> unit;

  static void fields(auto& self, auto&& field) {
    field("value", self.value, "with the effect");
    field("lower", self.lower, "of its 95 % interval");
    field("upper", self.upper, "of its 95 % interval");
    field("unit", self.unit, "of the values");
  }
};

struct ClaimedEffect {
  static constexpr const char* type_name = "claimed_effect";
  std::string name;
  std::optional<std::string> where, group;
  std::optional<ClaimedAmplitude> amplitude;
  std::optional<bool> accepted;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect");
    field("where", self.where, "its place");
    field("group", self.group, "effects of one group cannot be told apart");
    field("amplitude", self.amplitude, "its size");
    field("accepted", self.accepted, "it is said to be there");
  }
};

struct ClaimedGain {
  static constexpr const char* type_name = "claimed_gain";
  double before = 0, after = 0;

  static void fields(auto& self, auto&& field) {
    field("before", self.before, "root mean square held-out distance without what was accepted");
    field("after", self.after, "the same with it");
  }
};

/// What a score reads of explain.json, diagnosis.json or a file that another program made.
struct Claim {
  static constexpr const char* type_name = "claim";
  Verdict verdict = Verdict::undecided;
  std::vector<ClaimedEffect> effects;
  std::optional<ClaimedGain> held_out;
  std::optional<std::vector<std::string>> data;

  static void fields(auto& self, auto&& field) {
    field("verdict", self.verdict, "what is said of the model");
    field("effects", self.effects, "by their evidence, the strongest first");
    field("held_out", self.held_out, "distances on held-out data");
    field("data", self.data, "hashes of what the files of the measurements held; null: of another program");
  }
};

/// Throws InputError.
Claim read_claim(const std::filesystem::path& file);

/// How well one hidden effect was found.
struct FoundEffect {
  static constexpr const char* type_name = "found_effect";
  Answer::Effect hidden;
  std::optional<int> rank;
  bool accepted = false, in_accepted_group = false;
  std::optional<double> amplitude_error;
  std::optional<bool> within_interval;

  static void fields(auto& self, auto&& field) {
    Answer::Effect::fields(self.hidden, field);
    field("rank", self.rank, "1: listed first; null: not listed");
    field("accepted", self.accepted, "it is said to be there");
    field("in_accepted_group", self.in_accepted_group, "something of its group is");
    field("amplitude_error", self.amplitude_error, "found / hidden - 1; null: not found, or in another unit");
    field("within_interval", self.within_interval, "of the amplitude found");
  }
};

/// score.json (docs/twin.md).
struct Score {
  static constexpr const char* type_name = "score";
  Verdict verdict = Verdict::undecided, true_verdict = Verdict::undecided;
  bool verdict_right = false;
  std::vector<FoundEffect> found;
  std::vector<std::string> wrongly_accepted;
  std::optional<double> held_out_gain;

  static void fields(auto& self, auto&& field) {
    field("verdict", self.verdict, "as diagnosed");
    field("true_verdict", self.true_verdict, "as hidden");
    field("verdict_right", self.verdict_right, "and, of missing, what was accepted is what was hidden");
    field("effects", self.found, "that were hidden");
    field("wrongly_accepted", self.wrongly_accepted, "effects that were not hidden");
    field("held_out_gain", self.held_out_gain, "share of the held-out distance that the effects remove");
  }
};

Score score_of(const Claim& claim, const Answer& answer);

/// For people, a line each.
std::string text_of(const Score& score);

}  // namespace tether
