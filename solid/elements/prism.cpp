#include "solid/elements/prism.hpp"

#include <Eigen/LU>
#include <cmath>

namespace tether {
namespace {

using NodeVector = Eigen::Matrix<double, 6, 1>;
using Strains = StrainSamples<6, 12>;

struct QuadraturePoint {
  double xi, eta, zeta;
};

const double gauss = 1 / std::sqrt(3.0);

/// Three points in the plane (degree 2), two through the thickness; level-major: points 0-2 at -gauss, 3-5 at +gauss.
QuadraturePoint place(int point) {
  constexpr double xi[3] = {1.0 / 6, 2.0 / 3, 1.0 / 6}, eta[3] = {1.0 / 6, 1.0 / 6, 2.0 / 3};
  return {xi[point % 3], eta[point % 3], point < 3 ? -gauss : gauss};
}

Vec3 triangle_shape(double xi, double eta) {
  return {1 - xi - eta, xi, eta};
}

NodeVector shape(const QuadraturePoint& p) {
  NodeVector n;
  n << (1 - p.zeta) / 2 * triangle_shape(p.xi, p.eta), (1 + p.zeta) / 2 * triangle_shape(p.xi, p.eta);
  return n;
}

/// Derivatives of the shape functions by xi, eta, zeta: the columns.
Eigen::Matrix<double, 6, 3> derivatives(const QuadraturePoint& p) {
  const Vec3 by_xi(-1, 1, 0), by_eta(-1, 0, 1), n = triangle_shape(p.xi, p.eta);
  const double below = (1 - p.zeta) / 2, above = (1 + p.zeta) / 2;
  Eigen::Matrix<double, 6, 3> d;
  d.col(0) << below * by_xi, above * by_xi;
  d.col(1) << below * by_eta, above * by_eta;
  d.col(2) << -n / 2, n / 2;
  return d;
}

/// Samples 0-2 and 3-5: E11, E22, 2 E12 at the lower and upper Gauss level; 6-8: E33 linearised around the mean
/// vertical edge, at the three of them; 9: 2 E13 at (1/2, 0); 10: 2 E23 at (0, 1/2); 11: 2 (E23 - E13) at (1/2, 1/2);
/// the shears at zeta = 0. (S.7)
Strains make_strains() {
  Strains s;
  const auto set = [&s](int k, double factor, const NodeVector& a, const NodeVector& b) {
    s.factor[k] = factor;
    s.a.col(k) = a;
    s.b.col(k) = b;
  };
  for (int level = 0; level < 2; ++level) {
    const auto d = derivatives({1.0 / 3, 1.0 / 3, level == 0 ? -gauss : gauss});
    set(3 * level, 1, d.col(0), d.col(0));
    set(3 * level + 1, 1, d.col(1), d.col(1));
    set(3 * level + 2, 2, d.col(0), d.col(1));
  }
  constexpr double vertex[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  const NodeVector mean = derivatives({1.0 / 3, 1.0 / 3, 0}).col(2);
  for (int v = 0; v < 3; ++v) set(6 + v, 2, derivatives({vertex[v][0], vertex[v][1], 0}).col(2) - mean / 2, mean);
  const auto on_xi = derivatives({0.5, 0, 0}), on_eta = derivatives({0, 0.5, 0}), on_slope = derivatives({0.5, 0.5, 0});
  set(9, 2, on_xi.col(0), on_xi.col(2));
  set(10, 2, on_eta.col(1), on_eta.col(2));
  set(11, 2, on_slope.col(1) - on_slope.col(0), on_slope.col(2));
  return s;
}

/// Edge shears to the point: 2 E13 = s9 + c eta, 2 E23 = s10 - c xi with c = s10 - s9 - s11.
void set_shear(PrismElement::Map& map, const QuadraturePoint& p, const Eigen::Matrix<double, 6, 1>& e13,
               const Eigen::Matrix<double, 6, 1>& e23) {
  map.col(9) = (1 - p.eta) * e13 + p.xi * e23;
  map.col(10) = p.eta * e13 + (1 - p.xi) * e23;
  map.col(11) = -p.eta * e13 + p.xi * e23;
}

/// First-order change of the mean over the vertices of |g3 - mean g3|^2/2 = (D1^2 + D2^2 - D1.D2)/9, with D_a the
/// change of g3 along xi_a, by the in-plane samples: D_a . g_b is half the difference of E_ab between the levels over
/// gauss. (S.8)
Eigen::Matrix<double, 6, 1> fan_of(const PrismElement::Positions& reference, const Mat3& contravariant) {
  const auto edge = [&](double xi, double eta) -> Vec3 { return reference * derivatives({xi, eta, 0}).col(2); };
  const Vec3 d1 = edge(1, 0) - edge(0, 0), d2 = edge(0, 1) - edge(0, 0);
  const Eigen::Vector2d q1 = contravariant.leftCols<2>().transpose() * (2 * d1 - d2),
                        q2 = contravariant.leftCols<2>().transpose() * (2 * d2 - d1);
  const Vec3 upper = Vec3(q1[0], q2[1], (q1[1] + q2[0]) / 2) / (9 * 2 * gauss);
  Eigen::Matrix<double, 6, 1> fan;
  fan << -upper, upper;
  return fan;
}

}  // namespace

const StrainSamples<6, 12>& PrismElement::strains() {
  static const Strains instance = make_strains();
  return instance;
}

PrismElement::PrismElement(const Positions& reference) {
  const Mat3 centre = reference * derivatives({1.0 / 3, 1.0 / 3, 0});
  centre_contravariant_ = centre.inverse().transpose();
  for (int q = 0; q < points; ++q) {
    const QuadraturePoint p = place(q);
    const Mat3 covariant = reference * derivatives(p);
    const double jacobian = covariant.determinant();
    points_[static_cast<std::size_t>(q)] = {jacobian / 6, covariant.inverse().transpose(),
                                            p.zeta * centre.determinant() / jacobian};
  }
  fan_ = fan_of(reference, centre_contravariant_);
}

PrismElement::Map PrismElement::map(int point, double thickness_variation) const {
  const Mat3& g = points_[static_cast<std::size_t>(point)].contravariant;
  const QuadraturePoint p = place(point);
  const int level = point < 3 ? 0 : 3;
  Map map = Map::Zero();
  map.col(level) = voigt_dyad(g.col(0), g.col(0));
  map.col(level + 1) = voigt_dyad(g.col(1), g.col(1));
  map.col(level + 2) = voigt_dyad(g.col(0), g.col(1));
  const Vec3 mean = Vec3::Constant(1.0 / 3), weights = mean + thickness_variation * (triangle_shape(point) - mean);
  const Eigen::Matrix<double, 6, 1> e33 = voigt_dyad(g.col(2), g.col(2));
  map.leftCols<6>() += e33 * fan_.transpose();
  map.middleCols<3>(6) = e33 * weights.transpose();
  set_shear(map, p, voigt_dyad(g.col(0), g.col(2)), voigt_dyad(g.col(1), g.col(2)));
  return map;
}

Eigen::Matrix<double, 6, 1> PrismElement::enhanced_mode(int point) const {
  return points_[static_cast<std::size_t>(point)].enhanced *
         voigt_dyad(centre_contravariant_.col(2), centre_contravariant_.col(2));
}

Vec3 PrismElement::triangle_shape(int point) {
  const QuadraturePoint p = place(point);
  return tether::triangle_shape(p.xi, p.eta);
}

Eigen::Matrix<double, 6, 1> PrismElement::shape(int point) {
  return tether::shape(place(point));
}

/// int N_a N_b dV, exact for a constant Jacobian (the points in the plane have degree 2).
Eigen::Matrix<double, 6, 6> PrismElement::mass() const {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (int q = 0; q < points; ++q) {
    const NodeVector n = shape(q);
    sum += weight(q) * n * n.transpose();
  }
  return sum;
}

Mat3 PrismElement::mean_gradient(const Positions& x) const {
  return x * derivatives({1.0 / 3, 1.0 / 3, 0}) * centre_contravariant_.transpose();
}

double PrismElement::volume() const {
  double sum = 0;
  for (const Point& point : points_) sum += point.weight;
  return sum;
}

}  // namespace tether
