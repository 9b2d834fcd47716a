#pragma once

#include <Eigen/Core>

#include <bit>
#include <cmath>
#include <cstdint>

namespace tether {

/// Four numbers that are computed with at once. As the scalar of Eigen's small matrices it works a formula out for four
/// elements in the time of one. Products of such matrices must be lazy: blocking is for larger ones.
struct Pack {
  static constexpr int width = 4;
  /// Aligned as Eigen's matrices are without AVX; with it they are aligned to more anyway.
  using Lanes [[gnu::vector_size(8 * width), gnu::aligned(16)]] = double;

  Lanes lanes;

  Pack() = default;
  Pack(double x) : lanes{x, x, x, x} {}  // NOLINT(google-explicit-constructor): a number is one for all
  explicit Pack(const Lanes& all) : lanes(all) {}

  double operator[](int lane) const { return lanes[lane]; }
  void set(int lane, double x) { lanes[lane] = x; }

  Pack& operator+=(const Pack& x) {
    lanes += x.lanes;
    return *this;
  }
  Pack& operator-=(const Pack& x) {
    lanes -= x.lanes;
    return *this;
  }
  Pack& operator*=(const Pack& x) {
    lanes *= x.lanes;
    return *this;
  }
  Pack& operator/=(const Pack& x) {
    lanes /= x.lanes;
    return *this;
  }
  friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  friend Pack operator/(Pack a, const Pack& b) { return a /= b; }
  friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }
};

/// f of each lane.
template <class Function>
Pack each(const Pack& x, const Function& f) {
  Pack result;
  for (int lane = 0; lane < Pack::width; ++lane) result.lanes[lane] = f(x.lanes[lane]);
  return result;
}

inline Pack sqrt(const Pack& x) {
  return each(x, [](double a) { return std::sqrt(a); });
}
inline Pack abs(const Pack& x) {
  return each(x, [](double a) { return std::abs(a); });
}
inline Pack larger(const Pack& a, const Pack& b) {
  return Pack(a.lanes > b.lanes ? a.lanes : b.lanes);
}

/// Whether a > b in any lane; one that is no number is above nothing.
inline bool any_above(const Pack& a, const Pack& b) {
  for (int lane = 0; lane < Pack::width; ++lane)
    if (a.lanes[lane] > b.lanes[lane]) return true;
  return false;
}

/// x^(-1/3) of positive numbers, to rounding.
inline double inverse_cube_root(double x) {
  return 1 / std::cbrt(x);
}
/// Newton's method for y^-3 = x, from the bits of x: an exponent that is divided by three, and a mantissa that is right
/// to 4 %; the error e becomes 2 e^2 in each of four turns.
inline Pack inverse_cube_root(const Pack& x) {
  Pack y = each(
      x, [](double a) { return std::bit_cast<double>(0x553ef0ff289dd796U - std::bit_cast<std::uint64_t>(a) / 3); });
  for (int turn = 0; turn < 4; ++turn) y += y * (1.0 - x * y * y * y) * (1.0 / 3);
  return y;
}

}  // namespace tether

namespace Eigen {

template <>
struct NumTraits<tether::Pack> : GenericNumTraits<tether::Pack> {
  using Real = tether::Pack;
  using NonInteger = tether::Pack;
  using Literal = tether::Pack;
  using Nested = tether::Pack;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

template <class Operation>
struct ScalarBinaryOpTraits<tether::Pack, double, Operation> {
  using ReturnType = tether::Pack;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, tether::Pack, Operation> {
  using ReturnType = tether::Pack;
};

}  // namespace Eigen
