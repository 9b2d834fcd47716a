#pragma once

#include "common/observation/observations.hpp"

namespace tether {

/// How much each datum counts at a time: its precision W, the inverse of a variance, such that the estimate depends
/// neither on the time step nor on the density of the model's mesh. (K.5)
///
/// Lumen data with errors of deviation sigma, alike within the length l: W = w/(sigma^2 a), w the area (length) of the
/// sample and a = 2 pi l^2 (2 l) that of one independent error, at most all that is observed. In time: each frame
/// counts once, however many steps interpolate between two; frames closer than the correlation time share.
class DataPrecision {
 public:
  /// imaged: the lumen, to know which sample belongs to which series. dt: of the steps that will be corrected. run:
  /// start and end of the run, over which a frame that always holds counts once. All noise is stated (check_noise).
  DataPrecision(const Observations& data, const Points& imaged, double dt, std::pair<double, double> run);

  /// Of all lumen samples [m], from their weights (O.4; the smallest among the particles), at the end of a step.
  VectorXd of_samples(const VectorXd& weights, double time) const;
  /// Of all traces at a time; zero where a trace has no datum.
  VectorXd of_traces(double time) const;
  /// Standard deviations of single data: of samples, then of traces.
  const VectorXd& deviations() const { return deviations_; }
  /// Whether a frame of any lumen data lies in (begin, end]; of traces every time counts.
  bool has_frame(double begin, double end) const;
  /// In steps with frames only, each counts once whatever the step.
  void count_frames_whole() { whole_frames_ = true; }

 private:
  /// The frames of one contour or surface source that are used, their times ascending.
  struct Series {
    std::vector<double> times;
    double period, correlation_time, precision;  ///< precision: of a sample of weight 1 in one frame
  };
  double share_of_frame(const Series& series, double time) const;

  std::vector<Series> series_;          ///< of all sources
  std::vector<std::size_t> of_sample_;  ///< number in series_
  std::vector<Series> traces_;
  VectorXd deviations_;
  double dt_, run_start_, run_length_;
  bool whole_frames_ = false;
};

/// Throws InputError if the noise of some data is not stated.
void check_noise(const Observations& data, const CaseFile& file);

}  // namespace tether
