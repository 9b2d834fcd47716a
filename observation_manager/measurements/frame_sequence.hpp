#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tether {

/// What runs through the frames of a series: straight lines from each to the next, or polynomials of the third degree.
enum class FrameCurve { chord, cubic };

/// A time between two frames, and what data made there have of the frames around it. (O.3)
struct Between {
  std::int64_t before = 0;  ///< the last frame that is not behind the time
  double place = 0;         ///< s: of the two frames around alone, the later one has s and the earlier one 1 - s
  /// Of the frames before - 1, before, before + 1 and before + 2, by the curve; sum 1; 0 of those that have no part.
  std::array<double, 4> parts{0, 1, 0, 0};
  std::int64_t frame(std::size_t part) const { return before - 1 + static_cast<std::int64_t>(part); }
};

/// Frames that follow each other in time, numbered through all repetitions of a series that repeats.
class FrameSequence {
 public:
  /// times: ascending [time]. period: 0: the series does not repeat. slack: by which a time that misses a frame is on
  /// it, and frames this near to a first one that comes again are that one [time].
  FrameSequence(std::vector<double> times, double period, double slack, FrameCurve curve = FrameCurve::cubic);

  std::int64_t count() const { return std::ssize(times_); }
  double period() const { return period_; }
  bool exists(std::int64_t frame) const;
  double time_of(std::int64_t frame) const;
  /// Which of the given times a frame is.
  std::size_t number_of(std::int64_t frame) const;
  /// -1 before the first of a series that does not repeat.
  std::int64_t last_before(double time) const;
  /// Of the first frame before it, and of the last behind it. (O.3)
  Between around(double time) const;
  /// Expected square of the error of data made at a time, over that of a frame's own. (K.5)
  double error_square(const Between& around, double correlation_time) const;

 private:
  double place_between(std::int64_t before, double time) const;
  std::array<double, 4> parts_of(const Between& chord, double time) const;

  std::vector<double> times_;
  double period_, slack_;
  FrameCurve curve_;
};

}  // namespace tether
