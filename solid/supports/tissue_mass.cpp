#include "solid/supports/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration tissue_mass_declaration{
    .name = "tissue_mass",
    .meaning = "Tissue that the wall carries along: it makes the wall heavier",
    .place = Place::outer_wall,
    .parameters = {{.name = "mass",
                    .meaning = "mass of the surrounding tissue that moves with the wall, per area",
                    .dimension = {1, -2, 0},
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::log2,
                    .prior_deviation = 1.0,
                    .scale = 5.0}},
    .role = EffectRole::holds};

/// sigma n = - m a, a = (V - u0)/(theta dt): the step's own inertia (S.5), so that energy is conserved where it is
/// there. (S.16)
class TissueMass final : public Support {
 public:
  explicit TissueMass(std::span<const double> values) : mass_(values[0]) {}
  SupportTraction at(const SupportPoint& p) const override {
    SupportTraction result;
    result.traction = -mass_ * p.acceleration;
    result.inertia = mass_ * Mat3::Identity();
    return result;
  }

 private:
  double mass_;
};

}  // namespace

extern const Registered<Support> tissue_mass{
    tissue_mass_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<TissueMass>(values); }};

}  // namespace tether
