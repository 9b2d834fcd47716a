#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "observation_manager/measurements/frame_sequence.hpp"

namespace tether {

/// The steps of a run: their ends are start + i dt, i = 1, 2, ...
struct StepEnds {
  double start = 0, dt = 0;  ///< [time]
  double length = 0;         ///< of the run [time]
};

/// What the end of a step sees of a series.
struct SeenFrame {
  double share = 0;     ///< of a frame's weight, that falls to this step: all steps nearest to a frame share it alike
  bool is_own = false;  ///< of all steps' ends this is the one nearest to a frame
  double apart = std::numeric_limits<double>::infinity();  ///< from its neighbours, as steps can tell [time]
  double error_square = 1;  ///< of a datum's error there, expected, in squares of that of a frame (K.5)
};

/// What a datum between frames has of a frame.
struct FramePart {
  std::int64_t frame = 0;  ///< numbered through all repetitions
  double part = 0;         ///< 0: nothing
};

/// How the frames of one series, or the values of a trace, are shared out to the steps that see them, such that each
/// counts once. (K.5)
class FrameSharing {
 public:
  /// times: ascending, of what is used; none: nothing is seen; one NaN: a frame that holds always. period: 0: the
  /// series does not repeat. tolerance: how far from a frame that has no neighbour a time still is that frame's (O.3).
  /// correlation_time: of errors [time].
  FrameSharing(std::vector<double> times, double period, double tolerance, const StepEnds& ends,
               double correlation_time = 0, FrameCurve curve = FrameCurve::cubic);

  /// At the end of a step; a share of 0 if nothing is seen there.
  SeenFrame at(double end_of_step) const;
  /// Of which successive frames data at a time are made (O.3), at k those with a number that leaves k if divided by
  /// four. Not of a frame that holds always.
  std::array<FramePart, 4> parts_at(double time) const;

 private:
  std::int64_t step_before(double time) const;
  std::pair<std::int64_t, std::int64_t> steps_nearest_to(std::int64_t frame) const;
  std::int64_t own_step_of(std::int64_t frame) const;
  double spacing_at(std::int64_t frame) const;

  bool always_;  ///< its only frame
  FrameSequence frames_;
  double tolerance_, correlation_time_;
  StepEnds ends_;
};

}  // namespace tether
