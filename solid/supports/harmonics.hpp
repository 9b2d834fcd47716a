#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "common/base/effect.hpp"

namespace tether {

/// How a load goes with the beat: its mean and its first three harmonics,
///   f(t) = a_0 + sum_k (a_k cos(2 pi k t/T) + b_k sin(2 pi k t/T)),
/// in the order a_0 a_1 b_1 a_2 b_2 a_3 b_3. (S.17)
inline constexpr std::size_t harmonic_amplitudes = 7;

inline double harmonics(std::span<const double> amplitudes, double phase) {
  double sum = amplitudes[0];
  for (std::size_t k = 1; 2 * k < harmonic_amplitudes; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) * phase;
    sum += amplitudes[2 * k - 1] * std::cos(angle) + amplitudes[2 * k] * std::sin(angle);
  }
  return sum;
}

/// The seven amplitudes of a load, named prefix + "constant", "cosine_1", "sine_1", ...; `scale` in Pa.
inline void add_harmonics(std::vector<Parameter>& list, const std::string& prefix, const std::string& meaning,
                          double scale) {
  const auto add = [&](const std::string& name, const std::string& what) {
    list.push_back({.name = prefix + name,
                    .meaning = meaning + what,
                    .dimension = dimension::pressure,
                    .range = range::any,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::linear,
                    .prior_deviation = scale});
  };
  add("constant", ", constant in time");
  for (const char* k : {"1", "2", "3"}) {
    add(std::string("cosine_") + k, std::string(", times the cosine of harmonic ") + k);
    add(std::string("sine_") + k, std::string(", times the sine of harmonic ") + k);
  }
}

/// The duration of a beat and the time in which a load sets in: they are chosen, not identified.
inline void add_timing(std::vector<Parameter>& list) {
  list.push_back({.name = "period",
                  .meaning = "of the first harmonic",
                  .dimension = dimension::time,
                  .range = range::positive,
                  .standard = undefined,
                  .absent = undefined});
  list.push_back({.name = "ramp",
                  .meaning = "time from t = 0 on in which it sets in smoothly",
                  .dimension = dimension::time,
                  .range = range::not_negative,
                  .standard = 0.05,
                  .absent = undefined});
}

}  // namespace tether
