#include "diagnosis/search/judgement.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double noteworthy = 2;  ///< of what an error is allowed
/// Deviations of the misfit beyond noise: neither noise nor errors allowed do that.
constexpr double unexplainable = 6;

/// Allowed errors that somebody may look after, by how much of them the data ask for.
std::vector<StrainedError> strained_errors(const SearchEnd& end) {
  const EffectProblem& problem = end.problem;
  const VectorXd& deviation = problem.allowed_deviation;  // behind the allowed ones stand others that are left free
  const VectorXd found = end.trained.amplitudes(end.state.residual).head(deviation.size()).cwiseQuotient(deviation);
  std::vector<StrainedError> all;
  for (std::size_t k = 0; k < problem.allowed_errors.size(); ++k) {
    const auto column = static_cast<Index>(k);
    const auto& [name, amplitude] = problem.allowed_errors[k];
    if (name.empty() || std::abs(found(column)) <= noteworthy) continue;
    StrainedError& error = all.emplace_back();
    error.name = name;
    error.deviations = std::abs(found(column));
    if (!amplitude) continue;
    error.number = amplitude->name;
    error.value = amplitude->value(found(column) * deviation(column));
    error.unit = amplitude->unit;
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.deviations > b.deviations; });
  return all;
}

/// Of what is left now. (D.20)
Adequacy adequacy_of(const SearchEnd& end, const SearchResult& result) {
  const auto& errors = end.problem.allowed_errors;
  const auto named = std::count_if(errors.begin(), errors.end(), [](const auto& error) { return !error.name.empty(); });
  Adequacy found;
  found.whole = chi_square_tail(end.trained.counted_misfit(end.state.residual), static_cast<int>(result.independent));
  found.pooled = result.after.pooled;
  found.local = result.after.p;
  if (!result.strained.empty())
    found.errors = std::min(1.0, 2 * static_cast<double>(named) * normal_tail(result.strained.front().deviations));
  if (end.confirmation.has_data())
    found.held_out =
        chi_square_tail(end.confirmation.missed(end.state.residual), static_cast<int>(end.confirmation.independent()));
  return found;
}

/// Asked more strictly than of candidates, so that both questions together give hardly more false alarms than one.
bool leaves_patterns(const SearchEnd& end, const SearchResult& result) {
  return result.after.p < end.settings.alpha / 5;
}

bool leaves_something(const SearchEnd& end, const SearchResult& result) {
  const double beyond = result.independent + unexplainable * std::sqrt(2 * result.independent);
  return leaves_patterns(end, result) || end.trained.counted_misfit(end.state.residual) > beyond;
}

/// Of the part that the data ask for, what is left: the rest of the misfit's patterns beyond what noise may make.
bool leaves_too_much(const SearchEnd& end, const SearchResult& result) {
  const double removed = end.misfit_as_it_is - end.trained.misfit(end.state.residual);
  return leaves_something(end, result) && result.after.excess > end.settings.enough &&
         result.after.beyond_noise > end.settings.unexplained * (removed + result.after.beyond_noise);
}

/// Whether candidates that were not accepted only since they are not probable enough leave no lack of fit.
bool some_explain_it(const SearchEnd& end, const SearchResult& result) {
  return std::any_of(result.path.begin(), result.path.end(), [&](const SearchStep& step) {
    return step.objection && is_of_probability(*step.objection) && step.left.p >= end.settings.alpha;
  });
}

/// Whether something had the evidence, but was not confirmed.
bool stands_out(const SearchResult& result) {
  return std::any_of(result.path.begin(), result.path.end(),
                     [](const SearchStep& step) { return step.objection != Objection::too_weak; });
}

/// Whether any effect would be seen at the size that it may have in a patient.
bool sees_anything(const EffectProblem& problem, const SearchResult& result) {
  return std::any_of(result.effects.begin(), result.effects.end(), [&](const TestedEffect& effect) {
    const Candidate& candidate = problem.candidates[effect.candidate];
    const double scale = problem.amplitudes[static_cast<std::size_t>(candidate.amplitudes.front())].scale;
    return candidate.kind == Candidate::Kind::effect && std::abs(effect.visible) < scale;
  });
}

/// Whether another law would do as well as one that was accepted; variants of one law are told by its name.
bool has_rivals(const SearchEnd& end, const SearchResult& result) {
  const std::vector<Candidate>& candidates = end.problem.candidates;
  return std::any_of(result.effects.begin(), result.effects.end(), [&](const TestedEffect& effect) {
    return effect.rival && !is_variant(candidates[effect.candidate], candidates[end.rival_of[effect.candidate]]);
  });
}

/// Whether something of the model was accepted, no error of the data or of the mesh.
bool names_a_law(const SearchEnd& end) {
  return std::any_of(end.state.accepted.begin(), end.state.accepted.end(), [&](std::size_t candidate) {
    const Candidate::Kind kind = end.problem.candidates[candidate].kind;
    return kind == Candidate::Kind::effect || kind == Candidate::Kind::input;
  });
}

/// Whether the model lacks, as probably as not, what was refused since that is not sure.
bool leaves_open(const SearchResult& result) {
  constexpr double even = 0.5;
  const std::vector<WeighedGroup>& groups = result.weighed.groups;
  return std::any_of(result.path.begin(), result.path.end(), [&](const SearchStep& step) {
    return step.objection && is_of_probability(*step.objection) &&
           std::any_of(groups.begin(), groups.end(), [&](const WeighedGroup& group) {
             return group.probability > even && group.members.front() == step.candidate;
           });
  });
}

Verdict verdict_of(const SearchEnd& end, const SearchResult& result) {
  const bool accepted = !end.state.accepted.empty();
  if (leaves_too_much(end, result) && !result.more)
    return !accepted && some_explain_it(end, result) ? Verdict::undecided : Verdict::not_in_catalogue;
  const bool mesh_may_be_it = end.state.errors.cols() > 0;  // that takes held-out frames away from the model
  if (names_a_law(end) && is_refuted(result.held_out) && !mesh_may_be_it && !result.more) return Verdict::undecided;
  if (has_rivals(end, result)) return Verdict::ambiguous;
  if (names_a_law(end) && leaves_patterns(end, result) && !result.more) return Verdict::undecided;
  if (accepted && !names_a_law(end) && leaves_open(result)) return Verdict::undecided;
  if (accepted) return Verdict::missing;
  const bool is_decided = !stands_out(result) && sees_anything(end.problem, result) && !result.doubtful;
  return is_decided ? Verdict::nothing_missing : Verdict::undecided;
}

}  // namespace

void judge(const SearchEnd& end, SearchResult& result) {
  result.strained = strained_errors(end);
  result.adequacy = adequacy_of(end, result);
  result.doubtful = result.adequacy.p() < end.settings.alpha;
  if (!end.state.accepted.empty())
    result.held_out = end.confirmation.held_out(end.problem.residual, end.state.residual);
  result.verdict = verdict_of(end, result);
}

void judge_place(const std::optional<LocatedMisfit>& left, const EffectProblem& problem, SearchResult& result) {
  if (!is_no_noise(left)) return;
  result.doubtful = true;
  const bool is_named = std::any_of(result.effects.begin(), result.effects.end(), [&](const TestedEffect& effect) {
    return effect.accepted && problem.candidates[effect.candidate].takes_runs();
  });
  const bool says_all_is_well = result.verdict == Verdict::nothing_missing;
  if ((is_named && !result.more && result.verdict != Verdict::not_in_catalogue) || says_all_is_well)
    result.verdict = Verdict::undecided;
}

}  // namespace tether
