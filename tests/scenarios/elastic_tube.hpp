#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/fluid/womersley.hpp"

namespace tether::testing {

using Complex = std::complex<double>;

/// Waves ~ exp(i (omega t - k z)) in a long elastic tube full of viscous liquid: Womersley's theory
/// (1957) with Lame's thick wall in place of his membrane, the wall's bending, and the radial inertia of the liquid.
struct ElasticTube {
  double a, h;          ///< inner radius, thickness [length]
  double E, nu, rho_s;  ///< Young's modulus [pressure], Poisson's ratio, density of the wall
  double rho, mu;       ///< density, viscosity of the liquid
  double tether = 0;    ///< stiffness of the tissue that holds the wall along its axis [pressure/length]

  /// sqrt(E h / (2 rho a)): a thin wall, an inviscid liquid, a long wave.
  double moens_korteweg() const { return std::sqrt(E * h / (2 * rho * a)); }
  /// The same for a thick wall: sqrt(a p / (2 rho u)), u of Lame.
  double long_wave_speed() const {
    return std::sqrt(a / (2 * rho * (compliance() + (tether > 0 ? 0 : poisson_part()))));
  }

  /// k at omega, by Newton's method from a guess. The speed is omega / Re k, the damping per length - Im k.
  Complex wave_number(double omega) const { return wave_number(omega, omega / long_wave_speed()); }
  Complex wave_number(double omega, Complex guess) const {
    Complex k = guess;
    for (int i = 0; i < 30; ++i) {
      const Complex step = 1e-6 * k;
      k -= step * defect(k, omega) / (defect(k + step, omega) - defect(k, omega));
    }
    return k;
  }
  /// Radial displacement of the inner surface over the pressure on it.
  Complex radial(Complex k, double omega) const {
    const double mass = rho_s * section() / (2 * std::numbers::pi * a);
    const double bending = E * h * h * h / (12 * (1 - nu * nu));
    return (compliance() + I * nu * a * k * axial(k, omega)) /
           (1.0 + compliance() * (bending * std::pow(k, 4) - omega * omega * mass));
  }
  /// Axial velocity of the liquid over the pressure, at radius r. For long waves.
  Complex velocity(double r, Complex k, double omega) const {
    const Complex z = womersley(omega),
                  with_wall = fluid::testing::bessel_j(0, z * r / a) / fluid::testing::bessel_j(0, z);
    return k / (rho * omega) * (1.0 - with_wall) + I * omega * axial(k, omega) * with_wall;
  }

 private:
  static constexpr Complex I{0, 1};

  /// Of the balance of mass, k mean velocity = 2 omega / a radial displacement, over the pressure.
  Complex defect(Complex k, double omega) const {
    const Complex F = shear_share(omega);
    return k * (k / (rho * omega) * (1.0 - F) / radial_inertia(k) + I * omega * F * axial(k, omega)) -
           2 * omega / a * radial(k, omega);
  }
  double section() const { return std::numbers::pi * h * (2 * a + h); }
  /// Radial displacement over pressure (Lame) without axial strain,
  double compliance() const {
    const double outer2 = (a + h) * (a + h), inner2 = a * a;
    return (1 + nu) * a / E * ((1 - 2 * nu) * inner2 + outer2) / (outer2 - inner2);
  }
  /// and what the strain adds if there is no axial stress.
  double poisson_part() const { return 2 * nu * nu * a * a * std::numbers::pi * a / (E * section()); }
  /// Axial displacement of the wall over the pressure: inertia, stiffness, tether, the pressure by Poisson's ratio, and
  /// the liquid's shear pi a^2 F (i k p + rho omega^2 zeta) per length.
  Complex axial(Complex k, double omega) const {
    const Complex F = shear_share(omega);
    const double area = std::numbers::pi * a * a;
    const double outside = 2 * std::numbers::pi * (a + h);
    return I * area * k * (F - 2 * nu) /
           (section() * (E * k * k - rho_s * omega * omega) + outside * tether - area * rho * omega * omega * F);
  }
  Complex womersley(double omega) const { return std::pow(I, 1.5) * a * std::sqrt(omega * rho / mu); }
  /// F_10 = 2 J_1(z) / (z J_0(z)).
  Complex shear_share(double omega) const {
    const Complex z = womersley(omega);
    if (std::abs(z) > 12) return 2.0 / z * (I + 0.5 / z);  // asymptotic
    return 2.0 / z * fluid::testing::bessel_j(1, z) / fluid::testing::bessel_j(0, z);
  }
  /// (k a / 2) I_0(k a) / I_1(k a): pressure on the wall over the mean one.
  Complex radial_inertia(Complex k) const {
    const Complex z = I * k * a;  // J_0(i x) = I_0(x), J_1(i x) = i I_1(x)
    return z / 2.0 * fluid::testing::bessel_j(0, z) / fluid::testing::bessel_j(1, z);
  }
};

}  // namespace tether::testing
