#pragma once

#include "identification_master/frame_sharing.hpp"
#include "observation_manager/measurements/faults/allowance.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// An error of a source's data that is the same at all times.
struct LastingError {
  std::string source, name;  ///< "observations.surfaces.ct"; "bias", "displacement x", "region spine"
  double deviation = 0;      ///< that it may have before the data [length]
};

/// What data may be off by beside their noise, and what each of these errors does to them: some are the same at all
/// times, others as long as a frame is seen. Errors are numbered: first those of all times, then, of each series of
/// frames, those of four successive frames, of which data at a time are made, in the places that their numbers give
/// them.
class LastingColumns {
 public:
  /// Of no data.
  LastingColumns() = default;
  /// Of sources of places that are not held out, in the order of Observations::all(): the faults of the whole data that
  /// are allowed (a bias, a displacement), and a distance of each region, by the model's own mesh and step, in all
  /// frames alike and in each beside that. (K.8) imaged: the lumen. ends: of the steps that are corrected.
  LastingColumns(const Observations& data, const LumenSurface& lumen, const Points& imaged,
                 const LastingAllowance& allowed, const StepEnds& ends);

  /// q, of both kinds.
  Eigen::Index count() const;
  /// Those of all times.
  const std::vector<LastingError>& errors() const { return errors_; }
  /// N of (K.8), of errors as large as their deviations [m x q, length].
  MatrixXd at(double time) const;
  /// Those that are another frame's at a time than at an earlier one.
  std::vector<Eigen::Index> renewed(double before, double time) const;

 private:
  /// Of frames that are seen together: what a distance of each region does [m x regions].
  struct FrameColumns {
    FrameSharing frames;
    MatrixXd values;
  };
  class OfSource;

  std::vector<LastingError> errors_;
  MatrixXd values_;
  std::vector<FrameColumns> of_frames_;
};

}  // namespace tether
