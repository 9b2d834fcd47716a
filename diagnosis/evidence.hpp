#pragma once

#include "diagnosis/comparison.hpp"
#include "diagnosis/effect_problem.hpp"

namespace tether {

/// A finished run: its lumen and the columns of its table.
struct FinishedMotion {
  RunMotion motion;
  std::function<RunTrace(const std::string&)> trace;
  bool failed() const { return !motion.positions; }  ///< it did not come to its end
};

/// All that was measured, datum by datum: samples of each frame of each source, then values of each trace. The order is
/// the same for all runs. Values of a trace are held out where the closest frame is: a phase of the beat, with all that
/// was measured in it.
class Evidence {
 public:
  /// What is the same for a whole frame or trace.
  struct Part {
    std::size_t source = 0;  ///< number of the source; of a trace behind the sources
    Frame frame;             ///< of a source
    double time = 0;         ///< in the run
    Eigen::Index first = 0, count = 0;
  };

  /// base: the run that precisions are taken at (K.5).
  Evidence(const Observations& data, const LumenSurface& lumen, const FinishedMotion& base);

  /// Data minus model of each run, one column each; NaN where this run has no datum [n x runs].
  MatrixXd residuals(const std::vector<const FinishedMotion*>& runs) const;

  /// The residual at the base, precisions, blocks, training and held-out data. No candidates yet.
  EffectProblem problem() const;

  const std::vector<Part>& parts() const { return parts_; }
  bool is_trace(const Part& part) const { return part.source >= data_.lumen.size(); }
  std::string name_of(const Part& part) const;
  /// Root mean square distance of a frame from a lumen, such as the imaged one; infinite if nothing is observed
  /// [length].
  double distance_from(const Points& lumen, const Part& part) const;
  /// Its section in the case.
  std::string field_of(const Part& part) const;
  /// Of the data on the lumen at the base, where they are; zero for traces [length].
  const Eigen::Matrix3Xd& places() const { return places_; }
  /// Of the data on the lumen at the base: n out of the lumen, region (-1: none). Zero for traces.
  const Eigen::Matrix3Xd& normals() const { return normals_; }
  const std::vector<int>& regions() const { return region_; }
  /// Of the data on the lumen, the sum of the imaged lumen's two curvatures there; zero for traces [1/length].
  const std::vector<double>& curvatures() const { return curvature_; }
  /// Of the data on the lumen, how far along the vessel they are: 0 at an inlet, 1 at an outlet. Zero for traces.
  const std::vector<double>& along() const { return along_; }
  const std::vector<std::string>& region_names() const { return region_names_; }
  const Noise& noise(const Part& part) const;

 private:
  void add_frames(std::size_t source, const FinishedMotion& base);
  double along_vessel(const Sample& sample) const;
  void add_trace(std::size_t number, const FinishedMotion& base);
  std::size_t closest_frame(double time, std::size_t frames) const;

  const Observations& data_;
  const LumenSurface& lumen_;
  VectorXd nodal_curvature_;
  std::vector<std::string> region_names_;
  std::vector<Part> parts_;
  std::vector<double> residual_, precision_, independent_, along_, curvature_;
  std::vector<bool> held_out_;
  std::vector<int> region_, block_;
  std::vector<Vec3> normal_list_, place_list_;
  Eigen::Matrix3Xd normals_, places_;
  int blocks_ = 0;
};

}  // namespace tether
