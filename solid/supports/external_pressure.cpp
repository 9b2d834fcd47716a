#include "common/base/curve.hpp"
#include "solid/supports/harmonics.hpp"
#include "solid/supports/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration external_pressure_declaration{
    .name = "external_pressure",
    .meaning = "Pressure around the vessel, such as that in the chest, beyond what it was when the image was taken",
    .place = Place::outer_wall,
    .parameters =
        [] {
          std::vector<Parameter> list;
          add_harmonics(list, "", "pressure on the outer wall, inward", 500);
          add_timing(list);
          return list;
        }(),
    .role = EffectRole::loads,
    .target = EffectTarget::whole};

/// sigma n = - p(t) n, p by (S.17). (S.16)
class ExternalPressure final : public Support {
 public:
  explicit ExternalPressure(std::span<const double> values)
      : amplitudes_(values.begin(), values.begin() + harmonic_amplitudes),
        period_(values[harmonic_amplitudes]),
        ramp_(values[harmonic_amplitudes + 1]) {}
  SupportTraction at(const SupportPoint& p) const override {
    return {.traction = -onset(p.time, ramp_) * harmonics(amplitudes_, p.time / period_) * p.normal};
  }

 private:
  std::vector<double> amplitudes_;
  double period_, ramp_;
};

}  // namespace

extern const Registered<Support> external_pressure{external_pressure_declaration,
                                                   [](std::span<const double> values) -> std::unique_ptr<Support> {
                                                     return std::make_unique<ExternalPressure>(values);
                                                   }};

}  // namespace tether
