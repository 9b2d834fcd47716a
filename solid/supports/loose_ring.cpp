#include "solid/supports/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration loose_ring_declaration{
    .name = "loose_ring",
    .meaning = "An end ring held elastically instead of clamped",
    .place = Place::ring,
    .parameters = {{.name = "compliance",
                    .meaning = "displacement per traction, in every direction; 0: clamped",
                    .dimension = {-1, 2, 2},
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::log2,
                    .prior_deviation = 1.0,
                    .scale = 1e-7}},
    .role = EffectRole::replaces};

/// sigma n = - (y - y_b)/compliance; without compliance the ring is clamped. (S.16)
class LooseRing final : public Support {
 public:
  explicit LooseRing(std::span<const double> values) : stiffness_(values[0] > 0 ? 1 / values[0] : 0) {}
  SupportTraction at(const SupportPoint& p) const override {
    SupportTraction result;
    result.traction = -stiffness_ * p.displacement;
    result.stiffness = stiffness_ * Mat3::Identity();
    return result;
  }

 private:
  double stiffness_;
};

}  // namespace

extern const Registered<Support> loose_ring{
    loose_ring_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<LooseRing>(values); }};

}  // namespace tether
