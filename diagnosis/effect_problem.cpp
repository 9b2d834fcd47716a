#include "diagnosis/effect_problem.hpp"

#include <cmath>

namespace tether {

double Amplitude::value(double amplitude) const {
  return doubles ? base * std::exp2(amplitude) : base + amplitude;
}

ResidualAt linear_residual(const EffectProblem& problem) {
  return [&problem](const MatrixXd& amplitudes) -> MatrixXd {
    return (-problem.changes * amplitudes).colwise() + problem.residual;
  };
}

}  // namespace tether
