#pragma once

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/results/noise.hpp"

namespace tether {

/// What a case states of the noise of its frames, held against what a model leaves of them. problem: the data as they
/// are, not whitened, whose allowed errors other than patterns may have any size. residual: what is left [n]. further:
/// what else may have any size [n x k]. Sources with too few data or no correlation length are left out.
std::vector<NoiseCheck> noise_checks(const Evidence& evidence, const EffectProblem& problem, const VectorXd& residual,
                                     const MatrixXd& further);

}  // namespace tether
