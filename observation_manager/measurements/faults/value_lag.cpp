#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// A pressure comes late through its catheter, a trigger is late: all values are older than their times say.
class ValueLag : public FaultOf<ValueLag> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"value_lag", "All values of a trace are older than their times say"},
                                      .concerns = [](const Fallible& data) { return data.in_value; },
                                      .on_request = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    // 6.9 ms through a catheter of 1 m and 5.9 ms through 1.2 m of tubing: "Delay in transmission of a pressure impulse
    // through a cardiac catheter and vinyl plastic tubing".
    constexpr double catheter = 13e-3;  // [s]
    FaultNumber delay{"delay", "by how much values are older", dimension::time};
    delay.scale = catheter;
    return {{delay}, -data.rate};
  }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    return {{"time_shift", number_text(found.time_shift - found.number("delay"))}};
  }

  void declare_made(Fields& f, Dimension) override {
    f.number("delay", made_, dimension::time, range::any, "by which all values are older than their times say");
  }
  double delay(int) const override { return -made_; }

 private:
  double made_ = 0;
};

}  // namespace

std::unique_ptr<Fault> value_lag() {
  return std::make_unique<ValueLag>();
}

}  // namespace tether::faults
