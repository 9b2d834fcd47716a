#include "twin/random.hpp"

#include <cmath>
#include <numbers>

namespace tether {
namespace {

/// Spreads neighbouring numbers over all bits (Steele, Lea and Flood 2014).
std::uint64_t scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t purpose) : engine_(scattered(scattered(seed) + purpose)) {}

double Random::uniform() {
  return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53;
}

/// Box and Muller 1958; the distributions of the standard library differ between its implementations.
double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

}  // namespace tether
