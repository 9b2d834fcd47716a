#include "solid/elements/wall_local.hpp"

#include <cmath>

namespace tether {

FibreResponse fibre_response(const Fibres& fibres, double strain) {
  const double k = fibres.stiffness, c = fibres.exponent, square = strain * strain, growth = std::exp(c * square);
  const double energy = c > 0 ? k / (2 * c) * std::expm1(c * square) : k / 2 * square;
  return {energy, k * strain * growth, k * (1 + 2 * c * square) * growth};
}

}  // namespace tether
