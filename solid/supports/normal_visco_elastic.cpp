#include "solid/supports/registry.hpp"
#include "solid/supports/support_parameters.hpp"

namespace tether {
namespace {

const EffectDeclaration normal_visco_elastic_declaration{
    .name = "normal_visco_elastic",
    .meaning = "Tissue along which the wall slides freely: springs and dampers normal to the wall only",
    .place = Place::outer_wall,
    .parameters = {stiffness_parameter("traction per displacement along the normal"),
                   damping_parameter("traction per velocity along the normal")},
    .role = EffectRole::holds,
    .variant_of = "visco_elastic"};

/// sigma n = - (k y.n + c u.n) n
class NormalViscoElastic final : public Support {
 public:
  explicit NormalViscoElastic(std::span<const double> values) : stiffness_(values[0]), damping_(values[1]) {}
  SupportTraction at(const SupportPoint& p) const override {
    const Mat3 along_normal = p.normal * p.normal.transpose();
    return {-along_normal * (stiffness_ * p.displacement + damping_ * p.velocity), stiffness_ * along_normal,
            damping_ * along_normal};
  }

 private:
  double stiffness_, damping_;
};

}  // namespace

extern const Registered<Support> normal_visco_elastic{normal_visco_elastic_declaration,
                                                      [](std::span<const double> values) -> std::unique_ptr<Support> {
                                                        return std::make_unique<NormalViscoElastic>(values);
                                                      }};

}  // namespace tether
