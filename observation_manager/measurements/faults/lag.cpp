#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

struct MistimedFrame {
  ConcernedFrame frame;
  double shift = 0;
  void declare(Fields& f) {
    frame.declare(f);
    f.number("shift", shift, dimension::time, range::any, "the frame shows the vessel that much later than it says");
  }
};

/// Frames show the vessel later than they say, all of them or one.
class Lag : public FaultOf<Lag> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"gating_shift", "The times of all frames are off"},
                                      .of_frame = {"mistimed_frame", "One frame shows another moment than it says"},
                                      .concerns = [](const Fallible& data) { return data.in_place && data.in_time; }};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    return {{{"time_shift", "the frames show the vessel that much later than they say", dimension::time}}, data.rate};
  }
  double allowed(const AllowanceCase& allowed, double) const override { return allowed.time_shift.value_or(0); }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    return {{"time_shift", number_text(found.time_shift + found.number("time_shift"))}};
  }

  void declare_made(Fields& f, Dimension) override { f.group("mistimed", made_, "a frame with a wrong time"); }
  void check_made(int frames, const std::string& where) const override {
    if (made_) made_->frame.check(frames, where);
  }
  double delay(int frame) const override { return made_ && made_->frame.is(frame) ? made_->shift : 0; }

 private:
  std::optional<MistimedFrame> made_;
};

}  // namespace

std::unique_ptr<Fault> lag() {
  return std::make_unique<Lag>();
}

}  // namespace tether::faults
