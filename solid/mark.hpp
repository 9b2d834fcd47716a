#pragma once

#include <bit>
#include <cstdint>

namespace tether {

/// A number that differs for any other sequence of numbers (FNV-1a over whole doubles): tells data that were carried
/// unchanged from a mixture of several.
class Mark {
 public:
  template <class Numbers>
  Mark& add(const Numbers& numbers) {
    for (const double number : numbers) hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211u;
    return *this;
  }
  double value() const { return static_cast<double>(hash_ >> 12); }  ///< 52 bits are a whole number in a double

 private:
  std::uint64_t hash_ = 14695981039346656037u;
};

}  // namespace tether
