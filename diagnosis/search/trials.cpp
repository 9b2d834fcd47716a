#include "diagnosis/search/trials.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tether {

namespace {

using Index = Eigen::Index;

}  // namespace

Trials::Trials(const EffectProblem& problem, const Evidence& evidence, const Whitening& whitening,
               const FinishedMotion& base, ModelRuns& runs)
    : problem_(problem), evidence_(evidence), whitening_(whitening), base_(evidence.problem().residual), runs_(runs) {
  shift_ = problem.residual - whitening(residuals_of(evidence, {base}, base_)).col(0);
  known_[NamedValues{}] = Trial{base, problem.residual, VectorXd::Zero(problem.changes.cols())};
}

MatrixXd Trials::residual_at(const MatrixXd& amplitudes) {
  provide(amplitudes);
  MatrixXd residuals(problem_.residual.size(), amplitudes.cols());
  for (Index k = 0; k < amplitudes.cols(); ++k) residuals.col(k) = residual_with(amplitudes.col(k));
  return residuals;
}

VectorXd Trials::residual_with(const VectorXd& amplitudes) const {
  VectorXd residual = known_.at(values_of(amplitudes)).residual;
  for (const Candidate& candidate : problem_.candidates)
    if (!candidate.takes_runs())
      residual -= problem_.changes(Eigen::all, candidate.amplitudes) * amplitudes(candidate.amplitudes);
  return residual;
}

const FinishedMotion& Trials::motion_with(const VectorXd& amplitudes) const {
  return known_.at(values_of(amplitudes)).motion;
}

const FinishedMotion* Trials::find(const VectorXd& amplitudes) const {
  const auto found = known_.find(values_of(amplitudes));
  return found == known_.end() ? nullptr : &found->second.motion;
}

std::vector<double> Trials::sizes_of(std::size_t candidate) const {
  const Index own = problem_.candidates[candidate].amplitudes.front();
  const std::string& name = problem_.amplitudes[static_cast<std::size_t>(own)].name;
  std::vector<double> sizes;
  for (const auto& [values, trial] : known_)
    if (values.names == std::vector<std::string>{name}) sizes.push_back(trial.amplitudes(own));
  return sizes;
}

NamedValues Trials::values_of(const VectorXd& amplitudes) const {
  NamedValues all;
  for (const Candidate& candidate : problem_.candidates)
    for (const Index i : candidate.amplitudes) {
      if (!candidate.takes_runs() || amplitudes(i) == 0) continue;
      const Amplitude& amplitude = problem_.amplitudes[static_cast<std::size_t>(i)];
      all.names.push_back(amplitude.name);
      all.values.push_back(amplitude.value(amplitudes(i)));
    }
  return all;
}

void Trials::provide(const MatrixXd& amplitudes) {
  std::vector<WantedRun> wanted;
  std::vector<Index> column;
  for (Index k = 0; k < amplitudes.cols(); ++k) {
    NamedValues values = values_of(amplitudes.col(k));
    const bool is_there = known_.contains(values) || std::any_of(wanted.begin(), wanted.end(),
                                                                 [&](const auto& run) { return run.values == values; });
    if (is_there) continue;
    wanted.push_back({fmt::format("trials/runs/trial_{:03}", ++count_), std::move(values)});
    column.push_back(k);
  }
  if (wanted.empty()) return;
  const std::vector<FinishedMotion> motions = runs_.make(wanted);
  const MatrixXd residuals = whitening_(residuals_of(evidence_, motions, base_));
  for (std::size_t k = 0; k < wanted.size(); ++k)
    known_[wanted[k].values] =
        Trial{motions[k], residuals.col(static_cast<Index>(k)) + shift_, amplitudes.col(column[k])};
}

}  // namespace tether
