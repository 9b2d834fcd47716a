#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// A wrong threshold: the lumen is segmented too large or too small all over.
class Bias : public FaultOf<Bias> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{
        .of_all = {"segmentation_bias", "The measured lumen is too large or too small all over"},
        .concerns = [](const Fallible& data) { return data.in_threshold; },
        .ruled_out_by_image = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    return {{{"bias", "along the outward normal", dimension::length}}, VectorXd::Ones(data.places.cols())};
  }
  double allowed(const AllowanceCase& allowed, double noise) const override {
    return allowed.bias.value_or(0.5 * noise);
  }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    return {{"correction.outward", number_text(outward_ - found.number("bias"))}};
  }
  void declare_correction(Fields& f, Dimension) override {
    f.number("outward", outward_, dimension::length, range::any,
             "by which the measured lumen is moved out along its normal: that much was segmented too small");
  }
  double outward() const override { return outward_; }

  void declare_made(Fields& f, Dimension) override {
    f.number("bias", made_, dimension::length, range::any, "added along the outward normal, as by a wrong threshold");
  }
  double moved_outward() const override { return made_; }

 private:
  double outward_ = 0, made_ = 0;
};

}  // namespace

std::unique_ptr<Fault> bias() {
  return std::make_unique<Bias>();
}

}  // namespace tether::faults
