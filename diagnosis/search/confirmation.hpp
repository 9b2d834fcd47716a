#pragma once

#include <optional>

#include "diagnosis/search/held_out_gain.hpp"
#include "diagnosis/search/trained.hpp"

namespace tether {

inline constexpr double sure_gain = 0.95;  ///< probability of a gain on held-out data

/// How much less held-out data miss after an effect than before. (D.13) Of a problem that lives as long.
class Confirmation {
 public:
  explicit Confirmation(const EffectProblem& problem);
  Confirmation(const Confirmation&) = delete;
  Confirmation& operator=(const Confirmation&) = delete;

  /// Of residuals on all rows [n], with the numbers that may be anything as they fit the training data best; none where
  /// too few data that count are held out.
  std::optional<Gain> held_out(const VectorXd& before, const VectorXd& after) const;
  /// The same, or if that is not sure of what the training data and the allowed errors do not foretell.
  std::optional<Gain> of(const VectorXd& before, const VectorXd& after) const;
  /// What all held-out data that count still miss of a residual, of so many independent ones.
  double missed(const VectorXd& residual) const { return foretold_.misfit(residual).sum(); }
  double independent() const { return counted_.independent(counted_.held_out).sum(); }
  bool has_data() const { return !counted_.held_out.empty(); }

 private:
  std::vector<int> blocks() const;
  VectorXd refitted(const VectorXd& residual) const;

  const EffectProblem& problem_;
  EffectProblem counted_;
  Trained trained_;
  Foretold foretold_;
};

}  // namespace tether
