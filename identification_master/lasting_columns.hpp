#pragma once

#include "observation_manager/measurements/faults/allowance.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// An error of a source's data that is the same at all times.
struct LastingError {
  std::string source, name;  ///< "observations.surfaces.ct"; "bias", "displacement x", "region spine"
  double deviation = 0;      ///< that it may have before the data [length]
};

/// All that data may be off by at all times, and what each does to them.
struct LastingColumns {
  std::vector<LastingError> errors;
  MatrixXd values;  ///< N of (K.8), of errors as large as their deviations [m x q, length]
};

/// Of sources of places that are not held out, in the order of Observations::all(): the faults of the whole data that
/// are allowed (a bias, a displacement), and a distance of each region, by the model's own mesh and step. (K.8)
/// imaged: the lumen. start: of the run.
LastingColumns lasting_columns(const Observations& data, const LumenSurface& lumen, const Points& imaged,
                               const LastingAllowance& allowed, double start);

}  // namespace tether
