#pragma once

#include "twin/answer.hpp"

/// A diagnosis held against the sealed answer.
namespace tether {

/// What of diagnosis.json a score needs.
struct Diagnosis {
  struct Effect {
    std::string name, where, unit, group;  ///< effects of one group cannot be told apart; empty: none alike
    double amplitude = undefined, lower = undefined, upper = undefined;
    bool accepted = false;
  };
  std::string verdict;                                    ///< as in twin.hidden.verdict
  std::vector<Effect> effects;                            ///< by their evidence, the strongest first
  std::optional<double> held_out_before, held_out_after;  ///< root mean square of the held-out distances
};

/// Reads verdict, effects[] (name, where, amplitude {value, lower, upper, unit}, group, accepted) and held_out {before,
/// after}; of effects all but the name may be absent. Throws InputError.
Diagnosis read_diagnosis(const std::filesystem::path& file);

/// How well one hidden effect was found.
struct FoundEffect {
  Answer::Effect hidden;
  int rank = 0;  ///< 1: first; 0: not listed at all
  bool accepted = false, in_accepted_group = false;
  std::optional<double> amplitude_error;  ///< found / hidden - 1; nothing if their units differ, or none was found
  std::optional<bool> within_interval;
};

struct Score {
  std::string verdict, true_verdict;
  bool verdict_right = false;  ///< and, of 'missing', the accepted effects are those that were hidden
  std::vector<FoundEffect> found;
  std::vector<std::string> wrongly_accepted;  ///< "name at where"
  std::optional<double> held_out_gain;        ///< share of the held-out distance that the effects remove
};

Score score_of(const Diagnosis& diagnosis, const Answer& answer);

/// For people, a line each; and as score.json (docs/twin.md). Throws RunError if it cannot be written.
std::string text_of(const Score& score);
void write_json(const std::filesystem::path& file, const Score& score);

}  // namespace tether
