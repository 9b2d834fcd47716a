#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration thickness_factor_declaration{
    .name = "thickness_factor",
    .meaning = "The wall is thicker or thinner here than the imaged one",
    .place = Place::wall,
    .parameters = {{.name = "factor",
                    .meaning = "of the thickness: of the material per area",
                    .dimension = dimension::none,
                    .range = range::positive,
                    .standard = 1.0,
                    .absent = 1.0,
                    .transform = Transform::log2,
                    .prior_deviation = 0.3,
                    .scale = 0.3}},
    .role = EffectRole::replaces};

/// Elastic and viscous forces and mass times the factor, on the imaged shape; prestress stays as it is. (S.19)
class ThicknessFactor final : public WallEffect {
 public:
  explicit ThicknessFactor(double factor) : factor_(factor) {}
  void apply(WallLocal& local) const override { local.thickness *= factor_; }

 private:
  double factor_;
};

}  // namespace

extern const Registered<WallEffect> thickness_factor{thickness_factor_declaration,
                                                     [](std::span<const double> values) -> std::unique_ptr<WallEffect> {
                                                       return std::make_unique<ThicknessFactor>(values[0]);
                                                     }};

}  // namespace tether
