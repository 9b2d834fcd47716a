#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {
namespace {

/// mu = const.
class Newtonian : public Rheology {
 public:
  explicit Newtonian(double viscosity) : viscosity_(viscosity) {}
  double viscosity(double) const override { return viscosity_; }
  bool is_constant() const override { return true; }

 private:
  double viscosity_;
};

const EffectDeclaration newtonian_declaration{"newtonian",
                                              "blood of one viscosity, whatever the shear rate",
                                              Place::blood,
                                              {{"viscosity", "dynamic viscosity", dimension::viscosity, range::positive,
                                                undefined, undefined, Transform::log, 0.3}}};

}  // namespace

extern const Registered<Rheology> newtonian{
    newtonian_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Rheology> { return std::make_unique<Newtonian>(v[0]); }};

}  // namespace tether::fluid
