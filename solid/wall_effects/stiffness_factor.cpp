#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration stiffness_factor_declaration{
    .name = "stiffness_factor",
    .meaning = "The wall is stiffer or softer here than the case says, such as in a calcified or diseased part",
    .place = Place::wall,
    .parameters = {{.name = "factor",
                    .meaning = "of the stress that the law answers to strain",
                    .dimension = dimension::none,
                    .range = range::positive,
                    .standard = 1.0,
                    .absent = 1.0,
                    .transform = Transform::log2,
                    .prior_deviation = 0.5,
                    .scale = 0.5}},
    .role = EffectRole::replaces,
    .changes_along = true};

/// S <- factor S; prestress stays as it is. (S.19)
class StiffnessFactor final : public WallEffect {
 public:
  explicit StiffnessFactor(double factor) : factor_(factor) {}
  void apply(WallLocal& local) const override { local.stiffness *= factor_; }

 private:
  double factor_;
};

}  // namespace

extern const Registered<WallEffect> stiffness_factor{stiffness_factor_declaration,
                                                     [](std::span<const double> values) -> std::unique_ptr<WallEffect> {
                                                       return std::make_unique<StiffnessFactor>(values[0]);
                                                     }};

}  // namespace tether
