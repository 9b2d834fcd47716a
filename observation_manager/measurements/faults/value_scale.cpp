#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// An instrument of the wrong gain: all values are too large or too small by one factor.
class ValueScale : public FaultOf<ValueScale> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{
        .of_all = {"value_scale", "All values of a trace are too large or too small by one factor"},
        .concerns = [](const Fallible& data) { return data.in_value; },
        .on_request = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    return {{{"share", "of the values that is too much", {}, "1", -infinite, 1, 0.2}}, data.values};
  }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    return {{"correction.factor", number_text(factor_ * (1 - found.number("share")))}};
  }
  void declare_correction(Fields& f, Dimension) override {
    f.number("factor", factor_, dimension::none, range::positive, "of the values: so many times too small they were");
  }
  double corrected_value(double value) const override { return factor_ * value; }

  void declare_made(Fields& f, Dimension) override {
    f.number("factor", made_, dimension::none, range::positive, "of all values: so many times too large they are");
  }
  double spoilt_value(double value) const override { return made_ * value; }

 private:
  double factor_ = 1, made_ = 1;
};

}  // namespace

std::unique_ptr<Fault> value_scale() {
  return std::make_unique<ValueScale>();
}

}  // namespace tether::faults
