#include "solid/supports/registry.hpp"
#include "solid/supports/support_parameters.hpp"

namespace tether {
namespace {

const EffectDeclaration visco_elastic_declaration{
    .name = "visco_elastic",
    .meaning = "Tissue that holds the wall by springs and dampers in all directions (Moireau et al. 2012)",
    .place = Place::outer_wall,
    .parameters = {stiffness_parameter("traction per displacement, in every direction"),
                   damping_parameter("traction per velocity, in every direction")},
    .role = EffectRole::holds};

/// sigma n = - k y - c u
class ViscoElastic final : public Support {
 public:
  explicit ViscoElastic(std::span<const double> values) : stiffness_(values[0]), damping_(values[1]) {}
  SupportTraction at(const SupportPoint& p) const override {
    return {-stiffness_ * p.displacement - damping_ * p.velocity, stiffness_ * Mat3::Identity(),
            damping_ * Mat3::Identity()};
  }

 private:
  double stiffness_, damping_;
};

}  // namespace

extern const Registered<Support> visco_elastic{
    visco_elastic_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<ViscoElastic>(values); }};

}  // namespace tether
