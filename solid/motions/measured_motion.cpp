#include "solid/motions/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration measured_motion_declaration{
    .name = "measured_motion",
    .meaning = "The tissue that holds the wall moves as measured, such as the heart at the inlet ring",
    .place = Place::ring,
    .parameters = {{.name = "factor",
                    .meaning = "of the measured motion",
                    .dimension = dimension::none,
                    .range = range::any,
                    .standard = 1.0,
                    .absent = 0.0,
                    .transform = Transform::linear,
                    .prior_deviation = 0.5}},
    .role = EffectRole::loads};

/// y_b = factor measured(t) (S.18)
class MeasuredMotion final : public MotionLaw {
 public:
  explicit MeasuredMotion(double factor) : factor_(factor) {}
  AffineDisplacement at(double time, const TissueMotion& measured) const override { return factor_ * measured(time); }

 private:
  double factor_;
};

}  // namespace

const Registered<MotionLaw> measured_motion{
    measured_motion_declaration,
    [](std::span<const double> v) -> std::unique_ptr<MotionLaw> { return std::make_unique<MeasuredMotion>(v[0]); }};

}  // namespace tether
