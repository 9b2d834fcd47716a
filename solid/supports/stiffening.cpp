#include "solid/supports/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration stiffening_declaration{
    .name = "stiffening",
    .meaning = "Tissue that hardly holds the wall at first and ever more the farther it goes",
    .place = Place::outer_wall,
    .parameters = {{.name = "cubic",
                    .meaning = "traction per displacement to the third power, in every direction",
                    .dimension = {1, -4, -2},
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = 0.0,
                    .transform = Transform::log2,
                    .prior_deviation = 1.0,
                    .scale = 1e12}},
    .role = EffectRole::holds};

/// sigma n = - k3 |y|^2 y (S.16)
class Stiffening final : public Support {
 public:
  explicit Stiffening(std::span<const double> values) : cubic_(values[0]) {}
  SupportTraction at(const SupportPoint& p) const override {
    const Vec3& y = p.displacement;
    SupportTraction result;
    result.traction = -cubic_ * y.squaredNorm() * y;
    result.stiffness = cubic_ * (y.squaredNorm() * Mat3::Identity() + 2 * y * y.transpose());
    return result;
  }

 private:
  double cubic_;
};

}  // namespace

extern const Registered<Support> stiffening{
    stiffening_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<Stiffening>(values); }};

}  // namespace tether
