#include <numbers>

#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration fibres_declaration{
    .name = "fibres",
    .meaning = "Collagen fibres: the wall is stiffer along two directions, symmetric about that around the vessel",
    .place = Place::wall,
    .parameters = {{.name = "stiffness",
                    .meaning = "stress per strain along each family, where the image was taken",
                    .dimension = dimension::pressure,
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::log2,
                    .prior_deviation = 1.0,
                    .scale = 1e5},
                   {.name = "angle",
                    .meaning = "between each family and the direction around the vessel [degrees]; 90: along it",
                    .dimension = dimension::none,
                    .range = {0, 90},
                    .standard = 40.0,
                    .absent = undefined,
                    .transform = Transform::bounded,
                    .prior_deviation = 1.0},
                   {.name = "exponent",
                    .meaning = "of their stiffening with the square of the strain; 0: none",
                    .dimension = dimension::none,
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = undefined,
                    .transform = Transform::linear,
                    .prior_deviation = undefined}},
    .role = EffectRole::replaces};

/// Holzapfel, Gasser and Ogden 2000, from the imaged state and in both directions of strain. (S.20)
class FibreFamilies final : public WallEffect {
 public:
  explicit FibreFamilies(std::span<const double> v) : fibres_{v[0], v[2], v[1] * std::numbers::pi / 180} {}
  void apply(WallLocal& local) const override {
    if (fibres_.stiffness > 0) local.fibres.push_back(fibres_);
  }
  bool uses_axial() const override { return true; }

 private:
  Fibres fibres_;
};

}  // namespace

extern const Registered<WallEffect> fibres{fibres_declaration,
                                           [](std::span<const double> values) -> std::unique_ptr<WallEffect> {
                                             return std::make_unique<FibreFamilies>(values);
                                           }};

}  // namespace tether
