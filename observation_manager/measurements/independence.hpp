#pragma once

#include <cstddef>
#include <vector>

#include "common/base/types.hpp"
#include "observation_manager/measurements/noise.hpp"

/// How many independent data there are where errors are alike. (K.5)
namespace tether {

/// Area (dimension 2) or length (1) of one independent error: 2 pi l^2, 2 l, at most all that is observed.
double independent_part(const Noise& noise, int dimension, double observed);

/// What frames or values `apart` from each other count, of independent ones: 1/(1 + 2 sum_k exp(-k apart/tau)).
double independent_share(double apart, double correlation_time);

/// Mean distance in time of frames; infinite if there is one only.
double spacing(const std::vector<double>& times, double period);

/// How many independent errors those at these points amount to, if they correlate as exp(-r/l) (D.6).
double effective_points(const Points& points, double correlation_length);

}  // namespace tether
