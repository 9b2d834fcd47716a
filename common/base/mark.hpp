#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace tether {

/// A number that differs for any other sequence of numbers and words (FNV-1a over whole doubles): tells data that were
/// carried unchanged from a mixture of several, or from what belongs to something else.
class Mark {
 public:
  template <class Numbers>
  Mark& add(const Numbers& numbers) {
    for (const double number : numbers) hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211u;
    return *this;
  }
  Mark& add(std::string_view word) {
    for (const char letter : word) hash_ = (hash_ ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    hash_ = (hash_ ^ 256u) * 1099511628211u;  // where it ends
    return *this;
  }
  double value() const { return static_cast<double>(hash_ >> 12); }  ///< 52 bits are a whole number in a double

  /// Whether a mark that was carried along, averaged with equal ones perhaps, is this one.
  bool is(double carried) const { return std::abs(carried - value()) <= 1e-9 * value(); }

 private:
  std::uint64_t hash_ = 14695981039346656037u;
};

}  // namespace tether
