#include "diagnosis/search/race.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double the_same = 0.99;   ///< cosine
constexpr std::size_t at_once = 2;  ///< candidates that are run before others know what they are up against

/// What does the same to first order saturates alike.
void learn_from_look_alikes(std::vector<Refinement>& all, const EffectProblem& problem, const Scores& scores,
                            double misfit) {
  for (Refinement& one : all)
    for (const Refinement& other : all)
      if (!one.begun() && other.begun() && std::abs(cosine(problem, scores, one.effect(), other.effect())) > the_same)
        one.expect_at_most(misfit - std::min(other.best(), other.hope()));
}

}  // namespace

void Race::run(std::vector<Refinement>& all, const Scores& scores, double misfit, double near) {
  while (true) {
    std::vector<Refinement*> open;
    for (Refinement& one : all)
      if (!one.done() && one.runs() < settings_.refinements) open.push_back(&one);
    if (open.empty()) return;
    std::stable_sort(open.begin(), open.end(), [](const auto* a, const auto* b) { return a->hope() < b->hope(); });
    if (open.size() > at_once) open.resize(at_once);
    run_once(open);
    learn_from_look_alikes(all, problem_, scores, misfit);
    give_up_hopeless(all, near);
  }
}

void Race::run_once(const std::vector<Refinement*>& open) {
  MatrixXd wanted(problem_.changes.cols(), static_cast<Index>(open.size()));
  for (std::size_t i = 0; i < open.size(); ++i) wanted.col(static_cast<Index>(i)) = open[i]->amplitudes();
  const MatrixXd residuals = residual_at_(wanted);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto k = static_cast<Index>(i);
    open[i]->take(residuals.col(k));
    shown_.push_back({wanted.col(k), residuals.col(k)});
  }
}

}  // namespace tether
