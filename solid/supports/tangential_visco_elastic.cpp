#include "solid/supports/registry.hpp"
#include "solid/supports/support_parameters.hpp"

namespace tether {
namespace {

const EffectDeclaration tangential_visco_elastic_declaration{
    .name = "tangential_visco_elastic",
    .meaning =
        "Tissue that tethers the wall along itself and lets it bulge: springs and dampers tangential to the wall only",
    .place = Place::outer_wall,
    .parameters = {stiffness_parameter("traction per displacement tangential to the wall"),
                   damping_parameter("traction per velocity tangential to the wall")},
    .role = EffectRole::holds,
    .variant_of = "visco_elastic"};

/// sigma n = - (1 - n n') (k y + c u)
class TangentialViscoElastic final : public Support {
 public:
  explicit TangentialViscoElastic(std::span<const double> values) : stiffness_(values[0]), damping_(values[1]) {}
  SupportTraction at(const SupportPoint& p) const override {
    const Mat3 tangential = Mat3::Identity() - p.normal * p.normal.transpose();
    return {-tangential * (stiffness_ * p.displacement + damping_ * p.velocity), stiffness_ * tangential,
            damping_ * tangential};
  }

 private:
  double stiffness_, damping_;
};

}  // namespace

extern const Registered<Support> tangential_visco_elastic{
    tangential_visco_elastic_declaration, [](std::span<const double> values) -> std::unique_ptr<Support> {
      return std::make_unique<TangentialViscoElastic>(values);
    }};

}  // namespace tether
