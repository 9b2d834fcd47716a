#pragma once

#include <optional>
#include <vector>

namespace tether {

/// A time between two frames; before == after on a frame.
struct Between {
  std::size_t before = 0, after = 0;
  double share = 0;  ///< of `after`, s in (O.3)
};

/// The times of a series of frames, some of them held out: those are never used for a time in between.
class FrameTimes {
 public:
  /// `times` ascending; `period` 0: not periodic. A single frame without a time (NaN) holds always. `tolerance`: how
  /// far from a frame that has no neighbour a time still is that frame's.
  FrameTimes(std::vector<double> times, double period, double tolerance, const std::vector<bool>& held_out = {});

  /// Nothing outside the range of a series that is not periodic.
  std::optional<Between> at(double time) const;
  const std::vector<double>& times() const { return times_; }
  bool held_out(std::size_t frame) const { return held_out_[frame]; }

 private:
  std::vector<double> times_;
  double period_, tolerance_;
  std::vector<bool> held_out_;
  std::vector<std::size_t> used_;
};

}  // namespace tether
