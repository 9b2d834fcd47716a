#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solid/motions/registry.hpp"

namespace tether {
namespace {

Parameter amplitude_along(const char* axis) {
  return {.name = std::string("amplitude_") + axis,
          .meaning = std::string("amplitude of the tissue's motion along ") + axis,
          .dimension = dimension::length,
          .range = range::any,
          .standard = 0.0,
          .absent = 0.0,
          .transform = Transform::linear,
          .prior_deviation = 2e-3};
}

const EffectDeclaration breathing_declaration{
    .name = "breathing",
    .meaning =
        "The tissue that holds the wall moves to and fro, as the diaphragm does; what does not hold does not move",
    .place = Place::outer_wall,
    .parameters = {amplitude_along("x"),
                   amplitude_along("y"),
                   amplitude_along("z"),
                   {.name = "period",
                    .meaning = "of the motion",
                    .dimension = dimension::time,
                    .range = range::positive,
                    .standard = undefined,
                    .absent = undefined,
                    .transform = Transform::log,
                    .prior_deviation = 0.2},
                   {.name = "phase",
                    .meaning = "part of a period by which it is ahead at t = 0",
                    .dimension = dimension::none,
                    .range = {-1, 1},
                    .standard = 0.0,
                    .absent = undefined,
                    .transform = Transform::linear,
                    .prior_deviation = 0.25}},
    .role = EffectRole::loads};

/// y_b = A (sin(2 pi (t/T + phase)) - sin(2 pi phase)) (S.18)
class Breathing final : public MotionLaw {
 public:
  explicit Breathing(std::span<const double> v) : amplitude_(v[0], v[1], v[2]), period_(v[3]), phase_(v[4]) {}
  AffineDisplacement at(double time, const TissueMotion&) const override {
    const auto sine = [](double part) { return std::sin(2 * std::numbers::pi * part); };
    return {(sine(time / period_ + phase_) - sine(phase_)) * amplitude_};
  }

 private:
  Vec3 amplitude_;
  double period_, phase_;
};

}  // namespace

const Registered<MotionLaw> breathing{
    breathing_declaration,
    [](std::span<const double> v) -> std::unique_ptr<MotionLaw> { return std::make_unique<Breathing>(v); }};

}  // namespace tether
