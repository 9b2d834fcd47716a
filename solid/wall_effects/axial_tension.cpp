#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration axial_tension_declaration{
    .name = "axial_tension",
    .meaning = "The vessel is stretched along its length in the body: it resists going sideways like a string",
    .place = Place::wall,
    .parameters = {{.name = "stress",
                    .meaning = "along the vessel in the imaged wall; what it pulls there is held by the surroundings",
                    .dimension = dimension::pressure,
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::log2,
                    .prior_deviation = 1.0,
                    .scale = 2e4}},
    .role = EffectRole::replaces};

/// S <- S + stress e x e, less the force that this has on the imaged wall. (S.19)
class AxialTension final : public WallEffect {
 public:
  explicit AxialTension(double stress) : stress_(stress) {}
  void apply(WallLocal& local) const override { local.tension += stress_; }
  bool uses_axial() const override { return true; }

 private:
  double stress_;
};

}  // namespace

extern const Registered<WallEffect> axial_tension{axial_tension_declaration,
                                                  [](std::span<const double> values) -> std::unique_ptr<WallEffect> {
                                                    return std::make_unique<AxialTension>(values[0]);
                                                  }};

}  // namespace tether
