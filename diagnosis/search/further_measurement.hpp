#pragma once

#include <string>
#include <vector>

#include "diagnosis/evidence/effect_problem.hpp"

namespace tether {

/// What could be measured besides, as runs of the model would have it.
struct FurtherMeasurement {
  std::string name, assuming;   ///< "pressure at the inlet"; of its noise and times, for people
  MatrixXd values;              ///< of each run that is known [m x runs]
  VectorXd precision;           ///< W of each [m]
  double precision_factor = 1;  ///< of the data at hand instead: half their noise is 4
};

/// Two effects that the data at hand cannot tell apart, or one and none: the runs at their amplitudes.
struct Rivals {
  VectorXd residual, other_residual;              ///< of the data at hand [n]
  Eigen::Index run = 0, other_run = 0, base = 0;  ///< columns of a measurement's values; base: the model as it is
};

/// By how much the misfit of one rival would exceed that of the other if the other were true, on average: the other
/// scaled as fits best, and the errors that are allowed taken out, those of the inputs alike in old and new data. Of an
/// effect and none, by how much that of none would exceed the effect's if that were there. (D.15) measurement: null for
/// the data at hand alone.
double expected_difference(const EffectProblem& problem, const Rivals& rivals, const FurtherMeasurement* measurement);

/// A measurement and what it would tell.
struct Split {
  std::string measurement, assuming;
  double difference = 0;  ///< of the worst pair
};
/// All measurements, the best first; of several pairs the one that is hardest to tell apart counts.
std::vector<Split> splits(const EffectProblem& problem, const std::vector<Rivals>& rivals,
                          const std::vector<FurtherMeasurement>& measurements);

}  // namespace tether
