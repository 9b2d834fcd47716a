#pragma once

#include <Eigen/LU>
#include <cmath>

#include "common/base/types.hpp"

/// Closed forms for tubes in plane strain, inner radius a, outer radius b, from textbooks and not from the code.
namespace tether {

/// A tube of a linear isotropic material.
struct LinearTube {
  double a, b, young, poisson;
  double shear() const { return young / (2 * (1 + poisson)); }
};

/// Radial displacement at radius r under an inner pressure (Lame; Timoshenko and Goodier, Theory of Elasticity, section
/// 28).
inline double lame_displacement(const LinearTube& t, double pressure, double r) {
  const double ratio = pressure * t.a * t.a / (t.b * t.b - t.a * t.a);
  return (1 + t.poisson) / t.young * ratio * ((1 - 2 * t.poisson) * r + t.b * t.b / r);
}

/// A tube under the inner pressure p cos(2 theta): Airy's stress function (A r^2 + B r^4 + C r^-2 + D) cos(2 theta) of
/// Michell (1899); displacements after Barber, Elasticity, table 9.1.
class MichellOvalisation {
 public:
  MichellOvalisation(const LinearTube& tube, double pressure) : tube_(tube) {
    Eigen::Matrix4d conditions;
    conditions.row(0) = radial_stress_terms(tube.a);
    conditions.row(1) = shear_stress_terms(tube.a);
    conditions.row(2) = radial_stress_terms(tube.b);
    conditions.row(3) = shear_stress_terms(tube.b);
    c_ = conditions.fullPivLu().solve(Eigen::Vector4d(-pressure, 0, 0, 0));
  }
  /// Factors of cos(2 theta), sin(2 theta) for the shear and the hoop displacement.
  double radial_stress(double r) const { return radial_stress_terms(r).dot(c_); }
  double shear_stress(double r) const { return shear_stress_terms(r).dot(c_); }
  double hoop_stress(double r) const { return Eigen::RowVector4d(2, 12 * r * r, 6 * std::pow(r, -4), 0).dot(c_); }
  double radial_displacement(double r) const {
    const double kappa = 3 - 4 * tube_.poisson;
    return Eigen::RowVector4d(-2 * r, (kappa - 3) * r * r * r, 2 / (r * r * r), (kappa + 1) / r).dot(c_) /
           (2 * tube_.shear());
  }
  double hoop_displacement(double r) const {
    const double kappa = 3 - 4 * tube_.poisson;
    return Eigen::RowVector4d(2 * r, (kappa + 3) * r * r * r, 2 / (r * r * r), -(kappa - 1) / r).dot(c_) /
           (2 * tube_.shear());
  }

 private:
  static Eigen::RowVector4d radial_stress_terms(double r) { return {-2, 0, -6 * std::pow(r, -4), -4 / (r * r)}; }
  static Eigen::RowVector4d shear_stress_terms(double r) { return {2, 6 * r * r, -6 * std::pow(r, -4), -2 / (r * r)}; }
  LinearTube tube_;
  Eigen::Vector4d c_;
};

/// Ovalisation of a thin inextensible ring (Love 1927, sections 291-292; plane strain): w = p R^4/(9 D), D = E t^3/(12
/// (1 - nu^2)).
inline double thin_ring_ovalisation(const LinearTube& t, double pressure) {
  const double thickness = t.b - t.a, radius = (t.a + t.b) / 2;
  const double bending = t.young * std::pow(thickness, 3) / (12 * (1 - t.poisson * t.poisson));
  return pressure * std::pow(radius, 4) / (9 * bending);
}

/// Pressure that inflates an incompressible neo-Hookean tube of unstretched length to `stretch` times its inner radius:
/// p = mu (ln(la/lb) + (lb^-2 - la^-2)/2), la and lb the stretches at the two faces (integral of (l^2 - l^-2) dr/r).
inline double inflation_pressure(double a, double b, double shear, double stretch) {
  const double inner = stretch, outer = std::sqrt(1 + (stretch * stretch - 1) * a * a / (b * b));
  return shear * (std::log(inner / outer) + (1 / (outer * outer) - 1 / (inner * inner)) / 2);
}

/// The same for the compressible law mu/2 (I1 J^-2/3 - 3) + kappa/4 (J^2 - 1 - 2 ln J): equilibrium of the radial Piola
/// stress, dP/dR = (Q - P)/R with the hoop stress Q, integrated from the free outer face inward (Runge-Kutta, 200
/// steps).
class CompressibleInflation {
 public:
  CompressibleInflation(double a, double b, double shear, double bulk) : a_(a), b_(b), shear_(shear), bulk_(bulk) {}

  double pressure(double inner_stretch) const {
    double low = b_, high = b_ * inner_stretch;  // outer radius, by bisection
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (integrate(middle)[0] < inner_stretch * a_ ? low : high) = middle;
    }
    return -integrate(low)[1] / inner_stretch;
  }

 private:
  using State = Eigen::Vector2d;  // radius r, radial Piola stress P

  double piola(double along, double first, double second) const {  // dW/d(along), the other stretches first and second
    const double j = along * first * second, i1 = along * along + first * first + second * second;
    return shear_ * std::pow(j, -2.0 / 3) * (along - i1 / (3 * along)) + bulk_ / 2 * (j - 1 / j) * first * second;
  }
  double radial_stretch(double hoop, double stress) const {
    double stretch = 1 / hoop;
    for (int i = 0; i < 20; ++i) {
      const double h = 1e-6 * stretch;
      const double slope = (piola(stretch + h, hoop, 1) - piola(stretch - h, hoop, 1)) / (2 * h);
      stretch -= (piola(stretch, hoop, 1) - stress) / slope;
    }
    return stretch;
  }
  State slope(double place, const State& s) const {
    const double hoop = s[0] / place, radial = radial_stretch(hoop, s[1]);
    return {radial, (piola(hoop, radial, 1) - s[1]) / place};
  }
  State integrate(double outer_radius) const {
    constexpr int steps = 200;
    const double h = (a_ - b_) / steps;
    State s(outer_radius, 0);
    for (int i = 0; i < steps; ++i) {
      const double place = b_ + i * h;
      const State k1 = slope(place, s), k2 = slope(place + h / 2, s + h / 2 * k1),
                  k3 = slope(place + h / 2, s + h / 2 * k2), k4 = slope(place + h, s + h * k3);
      s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return s;
  }

  double a_, b_, shear_, bulk_;
};

}  // namespace tether
