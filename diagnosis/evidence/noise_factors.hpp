#pragma once

#include "diagnosis/evidence/effect_problem.hpp"

namespace tether {

/// Noise that is larger than this times what is stated is not taken for noise.
inline constexpr double largest_noise_factor = 1.3;

/// Of each source of data, by how much its noise is larger than stated, between 1 and `largest_noise_factor`: as what
/// no candidate, no allowed error and no pattern of a missing effect could make says, and twenty data that err as
/// stated. (D.20)
///
/// white: data as numbers of deviation 1. source: of each of these, from 0 [n].
std::vector<double> noise_factors(const EffectProblem& white, const std::vector<std::size_t>& source);

/// The same problem where the noise of each source is so much larger.
EffectProblem with_noise(EffectProblem white, const std::vector<std::size_t>& source,
                         const std::vector<double>& factors);

}  // namespace tether
