#include <Eigen/Geometry>

#include "common/base/curve.hpp"
#include "solid/supports/harmonics.hpp"
#include "solid/supports/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration traction_declaration{
    .name = "traction",
    .meaning = "A pull of unknown origin that goes with the beat: what the other effects do not explain",
    .place = Place::outer_wall,
    .parameters =
        [] {
          std::vector<Parameter> list;
          add_harmonics(list, "normal_", "traction along the outward normal", 500);
          add_harmonics(list, "axial_", "traction along the vessel, from its first ring", 500);
          add_harmonics(list, "around_", "traction around the vessel, right-handed about its direction", 500);
          add_timing(list);
          return list;
        }(),
    .role = EffectRole::loads,
    .generic = true};

/// sigma n = f_n(t) n + f_a(t) e + f_c(t) (e x n), e along the vessel (S.15), each f by (S.17). (S.16)
class Traction final : public Support {
 public:
  explicit Traction(std::span<const double> values)
      : values_(values.begin(), values.end()),
        period_(values[3 * harmonic_amplitudes]),
        ramp_(values[3 * harmonic_amplitudes + 1]) {}
  SupportTraction at(const SupportPoint& p) const override {
    const auto amplitude = [&](std::size_t direction) {
      return harmonics(std::span(values_).subspan(direction * harmonic_amplitudes), p.time / period_);
    };
    return {.traction = onset(p.time, ramp_) *
                        (amplitude(0) * p.normal + amplitude(1) * p.axial + amplitude(2) * p.axial.cross(p.normal))};
  }
  bool uses_axial() const override { return true; }

 private:
  std::vector<double> values_;
  double period_, ramp_;
};

}  // namespace

extern const Registered<Support> traction{
    traction_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<Traction>(values); }};

}  // namespace tether
