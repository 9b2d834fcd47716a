#include "solid/elements/wall_local.hpp"

#include <algorithm>
#include <cmath>

namespace tether {

FibreResponse fibre_response(const Fibres& fibres, double strain) {
  const double k = fibres.stiffness, c = fibres.exponent, square = strain * strain, growth = std::exp(c * square);
  const double energy = c > 0 ? k / (2 * c) * std::expm1(c * square) : k / 2 * square;
  return {energy, k * strain * growth, k * (1 + 2 * c * square) * growth};
}

WallLocal mixture(const std::vector<WallLocal>& parts, const std::vector<double>& shares) {
  if (std::all_of(parts.begin(), parts.end(), [](const WallLocal& part) { return part.is_plain(); })) return {};
  WallLocal mixed;
  mixed.stiffness = mixed.thickness = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) mixed.thickness += shares[i] * parts[i].thickness;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double of_matter = shares[i] * parts[i].thickness / mixed.thickness;
    mixed.stiffness += of_matter * parts[i].stiffness;
    mixed.tension += shares[i] * parts[i].tension;
    for (Fibres fibres : parts[i].fibres) {
      fibres.stiffness *= of_matter;
      if (shares[i] > 0) mixed.fibres.push_back(fibres);
    }
  }
  return mixed;
}

}  // namespace tether
