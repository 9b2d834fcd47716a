#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/base/curve.hpp"
#include "solid/motions/registry.hpp"
#include "solid/supports/harmonics.hpp"

namespace tether {
namespace {

constexpr std::size_t directions = 3, waves = 2;

/// x_cosine_1, x_sine_1, x_cosine_2, x_sine_2, then y and z, then the timing.
std::vector<Parameter> parameters() {
  std::vector<Parameter> list;
  for (const char* axis : {"x", "y", "z"})
    for (const char* wave : {"1", "2"})
      for (const char* part : {"cosine", "sine"})
        list.push_back(
            {.name = std::string(axis) + "_" + part + "_" + wave,
             .meaning = std::string("way of the tissue along ") + axis + ", times the " + part + " of harmonic " + wave,
             .dimension = dimension::length,
             .range = range::any,
             .standard = 0.0,
             .absent = 0.0,
             .transform = Transform::linear,
             .prior_deviation = 2e-3});
  add_timing(list);
  return list;
}

const EffectDeclaration moving_tissue_declaration{
    .name = "moving_tissue",
    .meaning = "The tissue that holds the wall moves with the beat, as the heart does that pulls at the aorta's root",
    .place = Place::ring,
    .parameters = parameters(),
    .role = EffectRole::loads,
    .generic = true};

/// y_b = r(t/ramp) sum_k (A_k (cos(2 pi k t/T) - 1) + B_k sin(2 pi k t/T)), k = 1, 2. (S.18)
class MovingTissueLaw final : public MotionLaw {
 public:
  explicit MovingTissueLaw(std::span<const double> values)
      : period_(values[2 * waves * directions]), ramp_(values[2 * waves * directions + 1]) {
    for (std::size_t axis = 0; axis < directions; ++axis)
      for (std::size_t k = 0; k < waves; ++k) {
        const std::size_t first = 2 * (waves * axis + k);
        cosines_[k][static_cast<Eigen::Index>(axis)] = values[first];
        sines_[k][static_cast<Eigen::Index>(axis)] = values[first + 1];
      }
  }
  AffineDisplacement at(double time, const TissueMotion&) const override {
    Vec3 way = Vec3::Zero();
    for (std::size_t k = 0; k < waves; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k + 1) * time / period_;
      way += (std::cos(angle) - 1) * cosines_[k] + std::sin(angle) * sines_[k];
    }
    return {.offset = onset(time, ramp_) * way};
  }

 private:
  std::array<Vec3, waves> cosines_, sines_;
  double period_, ramp_;
};

}  // namespace

const Registered<MotionLaw> moving_tissue{moving_tissue_declaration,
                                          [](std::span<const double> values) -> std::unique_ptr<MotionLaw> {
                                            return std::make_unique<MovingTissueLaw>(values);
                                          }};

}  // namespace tether
