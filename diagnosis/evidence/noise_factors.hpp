#pragma once

#include <map>

#include "diagnosis/evidence/whitening.hpp"

namespace tether {

/// Noise that is larger than this times what is stated is not taken for noise. That of long waves is twice as large
/// where errors are alike over twice the stated length.
inline constexpr double largest_noise_factor = 1.3, largest_of_long_waves = 2;

/// Of noise, by how much it is larger than stated.
using NoiseFactors = std::map<NoiseBand, double>;

/// Between 1 and what is taken for noise: as what no candidate, no allowed error and no pattern of a missing effect
/// could make says, and twenty data that err as stated. (D.20)
///
/// white: data as numbers of deviation 1. bands: of each of these [n].
NoiseFactors noise_factors(const EffectProblem& white, const std::vector<NoiseBand>& bands);

/// Of each datum, what it is divided by [n].
VectorXd larger_noise(const std::vector<NoiseBand>& bands, const NoiseFactors& factors);

/// The same problem where the noise of data is so much larger.
EffectProblem with_noise(EffectProblem white, const VectorXd& larger);

}  // namespace tether
