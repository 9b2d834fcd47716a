#pragma once

#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// What is known of the errors of a source.
struct Noise {
  double deviation = 0;           ///< of a value [its unit]; 0: not stated
  double correlation_length = 0;  ///< along the wall, or in the plane [length]
  double correlation_time = 0;    ///< [time]
};

inline Noise noise_of(const NoiseCase& given) {
  return {given.deviation, given.correlation_length, given.correlation_time};
}

}  // namespace tether
