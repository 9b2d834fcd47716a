#include <cmath>

#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// mu = mu_inf + (mu_0 - mu_inf) (1 + (lambda gamma)^a)^((n - 1)/a); Yasuda, Armstrong and Cohen 1981.
class CarreauYasuda : public Rheology {
 public:
  explicit CarreauYasuda(std::span<const double> v) : mu_inf_(v[0]), mu_0_(v[1]), lambda_(v[2]), n_(v[3]), a_(v[4]) {}
  double viscosity(double shear_rate) const override {
    return mu_inf_ + (mu_0_ - mu_inf_) * std::pow(1 + std::pow(lambda_ * shear_rate, a_), (n_ - 1) / a_);
  }

 private:
  double mu_inf_, mu_0_, lambda_, n_, a_;
};

const EffectDeclaration carreau_yasuda_declaration{
    "carreau_yasuda",
    "shear-thinning blood: thick where it hardly flows, thin where it is sheared fast",
    Place::blood,
    {{"viscosity", "dynamic viscosity at high shear rate", dimension::viscosity, range::positive, undefined, undefined,
      Transform::log, 0.3},
     {"viscosity_at_rest", "dynamic viscosity at shear rate zero", dimension::viscosity, range::positive, undefined,
      undefined, Transform::log, 0.5},
     {"relaxation_time", "inverse of the shear rate at which thinning begins", dimension::time, range::not_negative,
      1.902, undefined, Transform::linear, 1.0},
     {"index", "exponent n of the thinning; 1: none", dimension::none, {0, 1}, 0.22, 1.0, Transform::linear, 0.2},
     {"yasuda", "exponent a: how sharply thinning begins", dimension::none, range::positive, 1.25, undefined,
      Transform::log, 0.3}}};

}  // namespace

extern const Registered<Rheology> carreau_yasuda{
    carreau_yasuda_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Rheology> { return std::make_unique<CarreauYasuda>(v); }};

}  // namespace tether::fluid
