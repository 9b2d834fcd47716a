#pragma once

#include <algorithm>
#include <optional>

#include "diagnosis/evidence/set_evidence.hpp"
#include "diagnosis/results/phase_gain.hpp"
#include "diagnosis/results/probability_table.hpp"

namespace tether {

/// Candidates that together explain the data; none: the model as it is.
struct EffectSet {
  std::vector<std::size_t> members;  ///< ascending
  double probability = 0;            ///< that it is this set, and nothing outside the catalogue beside
  double with_more = 0;              ///< that it is this set, and something outside beside
  double with_unseen = 0;            ///< that it is this set, and two or more beside that the data hardly show
  bool by_runs = false;  ///< of sets that are not out of the question: runs showed what it does at about its amplitudes
  double all() const { return probability + with_more + with_unseen; }
  bool has(std::size_t candidate) const {
    return std::find(members.begin(), members.end(), candidate) != members.end();
  }
};

/// How probable each set of candidates is, all of them and what is outside of the catalogue together 1. (D.19)
struct Posterior {
  std::vector<EffectSet> sets;  ///< most probable first, of those that were looked at
  double nothing = 0;           ///< that the model lacks nothing
  double outside = 0;           ///< that something is missing, and no candidate is
  double discrepancy = 1;       ///< expected size of what the model itself is off, over what it may be, if no more is
  std::vector<double> prior;    ///< odds of each candidate beforehand
  std::vector<bool> left_out;   ///< of each candidate, whether it is none
  std::vector<double> unseen;   ///< of each candidate, that it is one of two or more that the data hardly show
  /// That a candidate is in the set.
  double of(std::size_t candidate) const;
  /// That one of these is.
  double of_any(const std::vector<std::size_t>& candidates) const;
  /// That none of these is, however little that is.
  double of_none(const std::vector<std::size_t>& candidates) const;
};

/// Candidates that do much the same: the data may want any of them.
struct WeighedGroup {
  double probability = 0;            ///< that it is one of them, whatever else
  double least = 0;                  ///< the smallest of these, with any one thing assumed otherwise
  std::vector<std::size_t> members;  ///< the most probable first
  std::vector<double> shares;        ///< of each, within the group
  std::vector<double> amplitudes;    ///< the most probable one of each; of several amplitudes NaN
  std::vector<bool>
      by_runs;  ///< whether a run of each, of the model itself, showed what it does at about that amplitude
  /// Of each but the first, whether the moments differ too much to say that the first foretells them better.
  std::vector<bool> as_good;
  /// Of the most probable set with its first member, over that without; of groups as probable as not.
  std::optional<PhaseGain> foretold;
  std::vector<std::size_t> faint = {};  ///< do much the same as the first, too improbable by themselves to be told
  bool has(std::size_t candidate) const;
  bool counts(std::size_t candidate) const;  ///< a member, or a faint one
  std::vector<std::size_t> all() const;      ///< members, then the faint ones
};

/// Groups that together explain the data, and nothing that is likely beside.
struct WeighedCombination {
  std::vector<int> groups;
  double probability = 0;
};

/// The same with something assumed otherwise.
struct WeighedOtherwise {
  Assumed what = Assumed::sizes;
  double factor = 1, nothing = 1;
  std::vector<double> groups;  ///< probability of each
};

/// A posterior as people read it, those groups first that the data can least do without.
struct Weighed {
  double nothing = 1, outside = 0, others = 0, more = 0;
  double discrepancy = 1;  ///< expected size of what the model itself is off, over what it may be
  std::vector<WeighedGroup> groups;
  std::vector<WeighedCombination> combinations;
  std::vector<WeighedOtherwise> otherwise;
  std::vector<double> detectable;  ///< of each candidate, the size that these data would show (D.12) [q]
};

/// Of groups that are as probable as not, how much better each moment is foretold with them, and with their first
/// member than with what does much the same and was run too: what the first does not foretell better for sure is a
/// member, as improbable as it may be if the noise is as stated. runs: what showed what candidates do.
void foretell_moments(Weighed& weighed, const EffectProblem& problem, const std::vector<ShownRun>& runs,
                      const Posterior& posterior);

/// All candidates by themselves, pairs of the best with all, and the best of these with the best; two that do much the
/// same are one or the other, since what they do together is not the sum of what each does. left_out: of each
/// candidate, whether it is none.
Posterior posterior_of(const EffectProblem& problem, const SetEvidence& evidence, const std::vector<bool>& left_out);

/// Two candidates do much the same where one leaves less than half of the square of what the other does.
Weighed weighed(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior);

/// The same where sizes may be half or twice as large, the noise 30 % smaller or larger, the model's own error half or
/// twice as large: each group's least probability, and what it was with each. Of the sets that are not out of the
/// question as things are assumed.
void weigh_otherwise(Weighed& weighed, const EffectProblem& problem, const std::vector<ShownRun>& runs,
                     const Posterior& posterior);

}  // namespace tether
