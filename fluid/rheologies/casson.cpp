#include <cmath>

#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// sqrt(mu) = sqrt(mu_c) + sqrt(tau_y / gamma) (1 - exp(-sqrt(m gamma))), regularised as Papanastasiou 1987:
/// mu(0) = (sqrt(mu_c) + sqrt(tau_y m))^2 instead of infinity.
class Casson : public Rheology {
 public:
  explicit Casson(std::span<const double> v) : mu_c_(v[0]), tau_y_(v[1]), m_(v[2]) {}
  double viscosity(double shear_rate) const override {
    const double s = std::sqrt(m_ * shear_rate);
    const double growth = s < 1e-8 ? 1.0 : -std::expm1(-s) / s;  // (1 - exp(-s)) / s
    const double root = std::sqrt(mu_c_) + std::sqrt(tau_y_ * m_) * growth;
    return root * root;
  }

 private:
  double mu_c_, tau_y_, m_;
};

const EffectDeclaration casson_declaration{
    "casson",
    "blood with a yield stress: it flows like a plug where the shear stress is small",
    Place::blood,
    {{"viscosity", "Casson viscosity, reached at high shear rate", dimension::viscosity, range::positive, undefined,
      undefined, Transform::log, 0.3},
     {"yield_stress", "shear stress below which blood hardly flows", dimension::pressure, range::not_negative,
      undefined, 0.0, Transform::linear, undefined},
     {"regularisation", "time m of the smoothing at shear rate zero", dimension::time, range::positive, 100.0,
      undefined, Transform::log, undefined}}};

}  // namespace

extern const Registered<Rheology> casson{
    casson_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Rheology> { return std::make_unique<Casson>(v); }};

}  // namespace tether::fluid
