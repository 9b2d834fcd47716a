#pragma once

#include "common/protocol/messages.hpp"
#include "identification_master/identified_parameters.hpp"

namespace tether {

/// A time step of all particles.
struct EnsembleStep {
  std::int64_t number = 0;
  double time = 0, dt = 0;
  bool observe = false;
};

/// What a particle's step found: its observables, its distances to the lumen data sample by sample, and its velocity
/// where that was measured.
struct ParticleReport {
  std::vector<double> observables, distances, weights;
  std::vector<double> velocities = {};  ///< three a point; NaN outside the lumen
  Points lumen = Points(3, 0);          ///< positions of its nodes, if they are known [length]
  std::int64_t evaluations = 0, krylov_iterations = 0, parts = 0;
};

/// The model, for many sets of parameters at once.
class Ensemble {
 public:
  virtual ~Ensemble() = default;
  /// What the model is and can do: names of parameters and observables, notices.
  virtual const protocol::Hello& model() const = 0;
  virtual VectorXd initial_state() = 0;
  /// Advances every particle, a column of `states`, with its own values. `memories`: what each particle's coupling
  /// remembers. Throws RunError that names the particle if one fails for good.
  virtual std::vector<ParticleReport> advance(const EnsembleStep& step, const std::vector<NamedValues>& values,
                                              MatrixXd& states, std::vector<std::vector<double>>& memories) = 0;
};

}  // namespace tether
