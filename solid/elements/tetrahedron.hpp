#pragma once

#include "common/base/types.hpp"
#include "solid/elements/strain_samples.hpp"

namespace tether {

/// The linear tetrahedron of the paper: constant strain. It locks in bending (docs/verification.md); kept for
/// comparisons.
struct TetrahedronElement {
  static constexpr int nodes = 4, samples = 6, points = 1;
  static constexpr bool enhanced = false;
  using Cell = Tetrahedron;
  using Positions = Eigen::Matrix<double, 3, nodes>;
  using Map = Eigen::Matrix<double, 6, samples>;

  explicit TetrahedronElement(const Positions& reference);

  const StrainSamples<nodes, samples>& strains() const { return strains_; }
  double weight(int) const { return volume_; }
  Map map(int, double) const { return Map::Identity(); }
  double volume() const { return volume_; }
  /// Deformation gradient for nodal positions x.
  Mat3 mean_gradient(const Positions& x) const { return x * gradient_; }
  /// int N_a N_b dV
  Eigen::Matrix<double, nodes, nodes> mass() const;

 private:
  StrainSamples<nodes, samples> strains_;
  Eigen::Matrix<double, nodes, 3> gradient_;  ///< of each shape function by x, y, z
  double volume_;
};

}  // namespace tether
