#include "fluid/inlet_profile.hpp"

#include <numbers>

#include "common/base/error.hpp"

namespace tether::fluid {
namespace {

constexpr int harmonics = 16;

/// c_0 ... c_harmonics of curve(t) = Re sum_k c_k exp(2 pi i k t / period), by sampling one period.
std::vector<std::complex<double>> coefficients(const PeriodicCurve& of) {
  constexpr int samples = 64 * (harmonics + 1);
  std::vector<std::complex<double>> result(harmonics + 1);
  for (int i = 0; i < samples; ++i) {
    const double time = of.start + of.period * i / samples, value = of.curve(time) * 2 / samples;
    for (int k = 0; k <= harmonics; ++k)
      result[static_cast<std::size_t>(k)] += value * std::polar(1.0, -2 * std::numbers::pi * k * time / of.period);
  }
  result[0] /= 2;
  return result;
}

}  // namespace

Profile profile_named(const std::string& name) {
  if (name == "flat") return Profile::flat;
  if (name == "parabolic") return Profile::parabolic;
  if (name == "womersley") return Profile::womersley;
  throw input_error("inlet profile \"{}\" is none of flat, parabolic, womersley", name);
}

InletProfile::InletProfile(const EndFace& face, Profile kind, const PeriodicCurve& curve, double kinematic_viscosity) {
  const Eigen::VectorXcd paraboloid = face.developed_profile(0);
  if (kind == Profile::flat) {
    steady_ = VectorXd::Zero(paraboloid.size());
    steady_(face.inner).setOnes();
  } else {
    steady_ = paraboloid.real();
  }
  steady_ /= face.integral(steady_.cast<std::complex<double>>()).real();
  if (kind != Profile::womersley) return;

  if (curve.period <= 0)
    throw input_error("the Womersley profile of inlet \"{}\" needs a periodic flow curve", face.name);
  omega_ = 2 * std::numbers::pi / curve.period;
  const auto c = coefficients(curve);
  for (int k = 1; k <= harmonics; ++k) {
    const Eigen::VectorXcd psi = face.developed_profile({0, k * omega_ / kinematic_viscosity});
    waves_.push_back(c[static_cast<std::size_t>(k)] / face.integral(psi) * psi);
  }
}

VectorXd InletProfile::oscillating(double curve_time) const {
  VectorXd speed = VectorXd::Zero(steady_.size());
  for (std::size_t k = 0; k < waves_.size(); ++k)
    speed += (waves_[k] * std::polar(1.0, static_cast<double>(k + 1) * omega_ * curve_time)).real();
  return speed;
}

Points InletProfile::velocity(const EndFace& face, double flow, double curve_time, double gain) const {
  const Vec3 inward = -face.area_vectors.rowwise().sum().normalized();
  const VectorXd waves = gain * oscillating(curve_time);
  const Points steady = inward * steady_.transpose(), oscillating = inward * waves.transpose();
  const double rest = flow + face.total_flux(oscillating);  // total_flux counts outward
  return oscillating + rest / -face.total_flux(steady) * steady;
}

}  // namespace tether::fluid
