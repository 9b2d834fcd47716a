#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// A zero that was set wrong: all values of an instrument are too high or too low.
class ValueOffset : public FaultOf<ValueOffset> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"value_offset", "All values of a trace are too high or too low"},
                                      .concerns = [](const Fallible& data) { return data.in_value; },
                                      .on_request = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    constexpr double of_range = 0.2;  // 8 mmHg of a pulse of 40: the deviation that ISO 81060-2 allows a cuff
    const double range = data.values.size() > 0 ? data.values.maxCoeff() - data.values.minCoeff() : 0;
    FaultNumber offset{"offset", "by how much values are too high", data.dimension};
    if (range > 0) offset.scale = of_range * range;
    return {{offset}, VectorXd::Ones(data.times.size())};
  }
  /// However many values there are, their mean is no better known: as the bias of lumens.
  double allowed(const AllowanceCase&, double noise) const override { return 0.5 * noise; }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    return {{"correction.offset", number_text(offset_ - found.number("offset"))}};
  }
  void declare_correction(Fields& f, Dimension of_values) override {
    f.number("offset", offset_, of_values, range::any, "added to the values: that much they were too low");
  }
  double corrected_value(double value) const override { return value + offset_; }

  void declare_made(Fields& f, Dimension of_values) override {
    f.number("offset", made_, of_values, range::any, "by which all values are too high");
  }
  double spoilt_value(double value) const override { return value + made_; }

 private:
  double offset_ = 0, made_ = 0;
};

}  // namespace

std::unique_ptr<Fault> value_offset() {
  return std::make_unique<ValueOffset>();
}

}  // namespace tether::faults
