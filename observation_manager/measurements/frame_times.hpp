#pragma once

#include <vector>

#include "observation_manager/measurements/frame_sequence.hpp"

namespace tether {

/// What data at a time have of a frame.
struct FrameShare {
  std::size_t frame = 0;
  double of_curve = 0;  ///< its part of the curve through the frames around (O.3)
  double of_chord = 0;  ///< its part of the straight line between the two frames around; 0: none of them
};

/// The times of a series of frames, some of them held out: those are never used for a time in between.
class FrameTimes {
 public:
  /// `times` ascending; `period` 0: not periodic. A single frame without a time (NaN) holds always. `tolerance`: how
  /// far from a frame that has no neighbour a time still is that frame's.
  FrameTimes(std::vector<double> times, double period, double tolerance, const std::vector<bool>& held_out = {});

  /// Frames of which data at a time are made, those that have no part left out; none outside the range of a series that
  /// is not periodic.
  std::vector<FrameShare> at(double time) const;
  const std::vector<double>& times() const { return times_; }
  bool held_out(std::size_t frame) const { return held_out_[frame]; }

 private:
  bool reaches(double time) const;

  std::vector<double> times_;
  double tolerance_;
  std::vector<bool> held_out_;
  std::vector<std::size_t> used_;  ///< those of sequence_
  FrameSequence sequence_;
};

}  // namespace tether
