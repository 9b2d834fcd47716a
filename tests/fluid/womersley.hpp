#pragma once

#include <complex>
#include <numbers>

/// Oscillating flow in a rigid tube of radius 1, in closed form (Womersley 1955).
namespace tether::fluid::testing {

/// Bessel's function J_n of a complex argument by its power series (|z| up to about 10).
inline std::complex<double> bessel_j(int n, std::complex<double> z) {
  std::complex<double> term = 1, sum = 0;
  for (int k = 1; k <= n; ++k) term *= z / 2.0 / static_cast<double>(k);
  for (int k = 1; k < 80; ++k) {
    sum += term;
    term *= -z * z / 4.0 / static_cast<double>(k * (k + n));
  }
  return sum;
}

/// psi of - laplace psi + alpha psi = 1, psi(1) = 0.
inline std::complex<double> developed_exact(std::complex<double> alpha, double r) {
  if (alpha == 0.0) return (1 - r * r) / 4;
  const std::complex<double> k = std::sqrt(-alpha);
  return (1.0 - bessel_j(0, k * r) / bessel_j(0, k)) / alpha;
}

/// int psi dA over the disc.
inline std::complex<double> developed_integral(std::complex<double> alpha) {
  const std::complex<double> k = std::sqrt(-alpha);
  return std::numbers::pi / alpha * (1.0 - 2.0 * bessel_j(1, k) / (k * bessel_j(0, k)));
}

/// Axial velocity for the flow Q(t) = cos(omega t).
inline double womersley_velocity(double omega, double nu, double r, double t) {
  const std::complex<double> alpha(0, omega / nu);
  return (developed_exact(alpha, r) / developed_integral(alpha) * std::polar(1.0, omega * t)).real();
}

/// - dp/dz for that flow.
inline double womersley_gradient(double omega, double nu, double rho, double t) {
  const std::complex<double> alpha(0, omega / nu);
  return (rho * nu / developed_integral(alpha) * std::polar(1.0, omega * t)).real();
}

}  // namespace tether::fluid::testing
