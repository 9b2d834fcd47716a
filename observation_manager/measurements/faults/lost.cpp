#include <algorithm>

#include "common/base/error.hpp"
#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// Frames are missing.
class Lost : public FaultOf<Lost> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.concerns = [](const Fallible& data) { return data.in_place; }};
    return all;
  }

  void declare_made(Fields& f, Dimension) override {
    f.numbers("lost", numbers_, {0, dimension::none, range::not_negative},
              "numbers of frames (from 0) that are missing");
  }
  void check_made(int frames, const std::string& where) const override {
    for (int frame = 0; frame < frames; ++frame)
      if (!loses(frame)) return;
    throw input_error("{}.lost: no frame is left", where);
  }
  bool loses(int frame) const override { return std::find(numbers_.begin(), numbers_.end(), frame) != numbers_.end(); }

 private:
  std::vector<double> numbers_;
};

}  // namespace

std::unique_ptr<Fault> lost() {
  return std::make_unique<Lost>();
}

}  // namespace tether::faults
