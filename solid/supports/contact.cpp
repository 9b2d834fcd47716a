#include <algorithm>

#include "solid/supports/registry.hpp"
#include "solid/supports/support_parameters.hpp"

namespace tether {
namespace {

const EffectDeclaration contact_declaration{
    .name = "contact",
    .meaning = "A hard neighbour, such as the spine: pushes the wall back where it comes closer, never holds it back",
    .place = Place::outer_wall,
    // A beat's pressure of 5 kPa presses the wall half a millimetre into it.
    .parameters = {stiffness_parameter("pressure per depth by which the wall has come too close", 1e7),
                   {.name = "gap",
                    .meaning = "way along its normal that the imaged wall is free to go before it touches",
                    .dimension = dimension::length,
                    .range = range::not_negative,
                    .standard = 0.0,
                    .absent = undefined,
                    .transform = Transform::linear,
                    .prior_deviation = 1e-3},
                   {.name = "smoothing",
                    .meaning = "depth over which the stiffness sets in",
                    .dimension = dimension::length,
                    .range = range::positive,
                    .standard = 2e-4,
                    .absent = undefined,
                    .transform = Transform::log2,
                    .prior_deviation = undefined}},
    .role = EffectRole::holds};

/// sigma n = - k s(y.n - gap) n; s(x) = 0, x^2/(2 w), x - w/2 for x below 0, up to w, above. (S.16)
class Contact final : public Support {
 public:
  explicit Contact(std::span<const double> values) : stiffness_(values[0]), gap_(values[1]), smoothing_(values[2]) {}
  SupportTraction at(const SupportPoint& p) const override {
    const double depth = p.displacement.dot(p.normal) - gap_;
    if (depth <= 0) return {};
    const double within = std::min(depth, smoothing_);
    SupportTraction result;
    result.traction = -stiffness_ * (depth - within + within * within / (2 * smoothing_)) * p.normal;
    const Mat3 along_normal = p.normal * p.normal.transpose();
    result.stiffness = stiffness_ * within / smoothing_ * along_normal;
    return result;
  }

 private:
  double stiffness_, gap_, smoothing_;
};

}  // namespace

extern const Registered<Support> contact{
    contact_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Support> { return std::make_unique<Contact>(values); }};

}  // namespace tether
