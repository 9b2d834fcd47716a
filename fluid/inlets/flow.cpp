#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fluid/inlets/inflow.hpp"

namespace tether::fluid {
namespace {

/// Q(t) = scale curve(t - shift) + offset + sum_k (a_k cos(2 pi k t/T) + b_k sin(2 pi k t/T)). (F.12), (F.16)
class PrescribedFlow : public Inflow {
 public:
  explicit PrescribedFlow(std::span<const double> v) : scale_(v[0]), shift_(v[1]), offset_(v[2]) {
    std::copy(v.begin() + 3, v.end(), harmonics_.begin());
  }
  double gain() const override { return scale_; }
  double curve_time(double time) const override { return time - shift_; }
  double added(double time, double period) const override {
    double sum = offset_;
    if (period <= 0) return sum;
    for (std::size_t k = 0; k < harmonics_.size() / 2; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k + 1) * time / period;
      sum += harmonics_[2 * k] * std::cos(angle) + harmonics_[2 * k + 1] * std::sin(angle);
    }
    return sum;
  }

 private:
  double scale_, shift_, offset_;
  std::array<double, 4> harmonics_;  // a_1 b_1 a_2 b_2
};

Parameter part(const char* name, const char* meaning) {
  return {name, meaning, dimension::flow, range::any, 0.0, 0.0, Transform::linear, 1e-5};
}

const EffectDeclaration flow_declaration{
    "flow",
    "a measured or chosen flow into the vessel",
    Place::inlet,
    {{"scale", "factor of the flow curve", dimension::none, range::any, 1.0, 1.0, Transform::linear, 0.1},
     {"shift", "delay of the flow curve", dimension::time, range::any, 0.0, 0.0, Transform::linear, 0.01},
     part("offset", "flow that the curve lacks, constant in time"),
     part("cosine_1", "flow that the curve lacks, times the cosine of its first harmonic; needs a period"),
     part("sine_1", "times the sine of the first harmonic; needs a period"),
     part("cosine_2", "times the cosine of the second harmonic; needs a period"),
     part("sine_2", "times the sine of the second harmonic; needs a period")},
    EffectRole::loads};

}  // namespace

extern const Registered<Inflow> flow{flow_declaration, [](std::span<const double> v) -> std::unique_ptr<Inflow> {
                                       return std::make_unique<PrescribedFlow>(v);
                                     }};

}  // namespace tether::fluid
