#pragma once

#include <cstdint>
#include <random>

namespace tether {

/// Random numbers that are the same on every machine for the same seed and purpose.
class Random {
 public:
  /// Different purposes of one seed are independent.
  Random(std::uint64_t seed, std::uint64_t purpose);

  double uniform();  ///< in (0, 1)
  double normal();   ///< mean 0, variance 1

 private:
  std::mt19937_64 engine_;
};

}  // namespace tether
