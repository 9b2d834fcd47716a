#include <cmath>

#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// mu = mu_inf (1 + excess (1 + (lambda gamma)^a)^((n - 1)/a)): Carreau and Yasuda's law with lambda, n, a of blood
/// (Cho and Kensey 1991), so that one number leads from Newtonian blood to them. (F.14)
class ShearThinning : public Rheology {
 public:
  explicit ShearThinning(std::span<const double> v) : mu_inf_(v[0]), excess_(v[1]) {}
  double viscosity(double shear_rate) const override {
    if (excess_ == 0) return mu_inf_;
    constexpr double lambda = 1.902, n = 0.22, a = 1.25;
    return mu_inf_ * (1 + excess_ * std::pow(1 + std::pow(lambda * shear_rate, a), (n - 1) / a));
  }
  bool is_constant() const override { return excess_ == 0; }

 private:
  double mu_inf_, excess_;
};

const EffectDeclaration shear_thinning_declaration{
    "shear_thinning",
    "blood that is thicker where it hardly flows; without excess the same as newtonian",
    Place::blood,
    {{"viscosity", "dynamic viscosity at high shear rate", dimension::viscosity, range::positive, undefined, undefined,
      Transform::log, 0.3},
     {"excess", "viscosity at rest beyond that at high shear rate, over it; 15 in blood", dimension::none,
      range::not_negative, 0.0, 0.0, Transform::log2, 1.0, 15.0}}};

}  // namespace

extern const Registered<Rheology> shear_thinning{
    shear_thinning_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Rheology> { return std::make_unique<ShearThinning>(v); }};

}  // namespace tether::fluid
