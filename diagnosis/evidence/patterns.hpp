#pragma once

#include "diagnosis/evidence/diagnosis_case.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tether {

/// Each region at each moment (all along the vessel, one end against the other, the ends against the middle), and over
/// the beat (constant, cosine, sine): what may be off without any effect's doing (D.11). As errors of the model's mesh
/// they are allowed.
void add_patterns(EffectProblem& problem, const Evidence& evidence, const AllowanceCase& allowed, double start,
                  double end);

}  // namespace tether
