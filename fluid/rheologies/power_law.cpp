#include <cmath>

#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// mu = mu_1 ((gamma^2 + gamma_0^2) / s^2)^((n - 1)/2), s = 1/second: mu_1 is the viscosity at the shear rate of one
/// per second.
class PowerLaw : public Rheology {
 public:
  explicit PowerLaw(std::span<const double> v) : mu_1_(v[0]), n_(v[1]), gamma_0_(v[2]) {}
  double viscosity(double shear_rate) const override {
    return mu_1_ * std::pow(shear_rate * shear_rate + gamma_0_ * gamma_0_, 0.5 * (n_ - 1));
  }

 private:
  double mu_1_, n_, gamma_0_;
};

const EffectDeclaration power_law_declaration{
    "power_law",
    "blood whose viscosity is a power of the shear rate",
    Place::blood,
    {{"viscosity", "dynamic viscosity at a shear rate of one per second", dimension::viscosity, range::positive,
      undefined, undefined, Transform::log, 0.3},
     {"index",
      "exponent n; 1: Newtonian, below: thinning",
      dimension::none,
      {0, 2, true, false},
      undefined,
      1.0,
      Transform::linear,
      0.2},
     {"lowest_shear_rate", "below it the viscosity no longer grows", dimension::rate, range::positive, 0.1, undefined,
      Transform::log, undefined}}};

}  // namespace

extern const Registered<Rheology> power_law{
    power_law_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Rheology> { return std::make_unique<PowerLaw>(v); }};

}  // namespace tether::fluid
