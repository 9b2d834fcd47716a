#pragma once

#include "identification_master/frame_sharing.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// Of each datum at the end of a step, source after source.
struct DatumWeights {
  VectorXd precision;          ///< W of (K.5); zero where there is no datum
  VectorXd expected_squares;   ///< of its error, in squares of the deviation: below 1 between two frames (K.5)
  std::vector<bool> on_frame;  ///< whether it is a frame's own, and not only in between
};

/// How much each datum counts at a time: its precision W, the inverse of a variance, such that the estimate depends
/// neither on the time step nor on the density of the model's mesh. (K.5)
///
/// Every source says what its rows and their errors are: of lumen data with errors of deviation sigma, alike within the
/// length l, W = w/(sigma^2 a), w the area (length) of the sample and a = 2 pi l^2 (2 l) that of one independent error,
/// at most all that is observed. In time: each frame counts once, however many steps interpolate between two; frames
/// closer than the correlation time share. What is held out counts nothing.
class DataPrecision {
 public:
  /// imaged: the lumen, to know which sample belongs to which series. dt: of the steps that will be corrected. run:
  /// start and end of the run, over which a frame that always holds counts once. All noise is stated (check_noise).
  DataPrecision(const Observations& data, const Points& imaged, double dt, std::pair<double, double> run);

  /// At the end of a step, from the rows' weights (O.4; the smallest among the particles).
  DatumWeights at(const VectorXd& weights, double end_of_step) const;
  /// Standard deviations of single data.
  const VectorXd& deviations() const { return deviations_; }
  /// Whether a frame, or a value of a trace, has this step of its own.
  bool has_frame(double end_of_step) const;
  /// Each frame counts in its own step only.
  void count_frames_whole() { whole_frames_ = true; }

 private:
  /// The frames of one contour or surface source, or the values of a trace.
  struct Series {
    FrameSharing frames;
    double correlation_time, precision;  ///< precision: of a sample of weight 1 in one frame
  };
  /// What of a series' precision counts at a time, and what its errors' squares are.
  struct Weight {
    double factor, expected_square;
    bool on_frame;
  };
  void add(const Measurement& source, const Points& imaged, const StepEnds& ends);
  Weight weight_of(const Series& series, double end_of_step) const;

  std::vector<Series> series_;       ///< of all sources
  std::vector<std::size_t> of_row_;  ///< number in series_
  VectorXd deviations_;
  bool whole_frames_ = false;
};

/// Throws InputError if the noise of data that are used is not stated.
void check_noise(const Observations& data, const CaseFile& file);

}  // namespace tether
