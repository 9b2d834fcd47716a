#pragma once

#include "common/base/types.hpp"
#include "solid/elements/strain_samples.hpp"

namespace tether {

/// The default wall element: a six-node solid-shell prism that does not lock. Unknowns are the positions of its nodes
/// only.
///
/// Parent coordinates (xi, eta) on the triangle, zeta in [-1, 1] from the lumen outward. Green-Lagrange strains in
/// these coordinates (S.7), with
/// - in-plane 11, 22, 12: as they are, at the two Gauss levels zeta = -+1/sqrt(3);
/// - transverse shear 13, 23: from the edges' midpoints, constant tangential strain along each edge (MITC3: Lee and
/// Bathe 2004): no shear locking;
/// - thickness 33: of the mean of the three vertical edges, and its linear variation along them, which enters only as
/// far as shear resists it, so that a nearly incompressible wall does not lock in its plane. Not the edges' own squared
/// lengths: tilts against each other, which the shears at the midpoints do not see, would shorten the wall at second
/// order and make it give way under a few percent of its shear modulus as pressure. What bending changes in those
/// lengths where the edges fan out, in a curved wall, is put back from the in-plane samples: no curvature-thickness
/// locking (Betsch and Stein 1995) (S.8);
/// - one enhanced mode, linear in zeta, of the thickness strain (Buechter, Ramm and Roehl 1994; Simo and Rifai 1990),
/// eliminated in the element: no Poisson-thickness and no volumetric locking in bending (S.10).
/// These are twelve numbers, as many as the element has ways to deform.
struct PrismElement {
  static constexpr int nodes = 6, samples = 12, points = 6;
  static constexpr bool enhanced = true;
  using Cell = Prism;
  using Positions = Eigen::Matrix<double, 3, nodes>;
  using Map = Eigen::Matrix<double, 6, samples>;

  explicit PrismElement(const Positions& reference);

  static const StrainSamples<nodes, samples>& strains();
  /// Of the three corners at a quadrature point: 1 - xi - eta, xi, eta.
  static Vec3 triangle_shape(int point);
  /// Of the six nodes there.
  static Eigen::Matrix<double, nodes, 1> shape(int point);
  double weight(int point) const { return points_[static_cast<std::size_t>(point)].weight; }
  /// From the samples to the Cartesian strain at a quadrature point. thickness_variation: see `WallLaw`.
  Map map(int point, double thickness_variation) const;
  /// Cartesian strain of the enhanced mode at a quadrature point; its integral over the element is zero (patch test).
  Eigen::Matrix<double, 6, 1> enhanced_mode(int point) const;
  double volume() const;
  /// Unit normal of the middle surface at the centre: the direction of the enhanced mode.
  Vec3 thickness_direction() const { return centre_contravariant_.col(2).normalized(); }
  /// Deformation gradient at the centre for nodal positions x.
  Mat3 mean_gradient(const Positions& x) const;
  Eigen::Matrix<double, nodes, nodes> mass() const;

 private:
  friend class PrismPack;
  struct Point {
    double weight;
    Mat3 contravariant;  ///< columns G^1, G^2, G^3
    double enhanced;     ///< zeta J0/J
  };
  std::array<Point, points> points_;
  Mat3 centre_contravariant_;        ///< columns G^1, G^2, G^3 at the centre
  Eigen::Matrix<double, 6, 1> fan_;  ///< thickness strain by the in-plane samples
};

}  // namespace tether
