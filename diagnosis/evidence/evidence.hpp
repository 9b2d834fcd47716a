#pragma once

#include "diagnosis/comparison/comparison.hpp"
#include "diagnosis/evidence/effect_problem.hpp"

namespace tether {

/// All that was measured, datum by datum: those of each frame of each source, then the values of records. The order is
/// the same for all runs. Values of a record are held out where the closest frame is: a phase of the beat, with all
/// that was measured in it.
class Evidence {
 public:
  /// What is the same for a whole frame or record.
  struct Part : MeasuredPart {
    std::size_t source = 0;  ///< its number among all
    Eigen::Index first = 0, count = 0;
  };

  /// base: the run that precisions are taken at (K.5).
  Evidence(const Observations& data, const LumenSurface& lumen, const FinishedMotion& base);

  /// Data minus model of each run, one column each; NaN where this run has no datum [n x runs].
  MatrixXd residuals(const std::vector<const FinishedMotion*>& runs) const;

  /// The residual at the base, precisions, blocks, training and held-out data. No candidates yet.
  EffectProblem problem() const;

  const std::vector<Part>& parts() const { return parts_; }
  const Measurement& source(const Part& part) const { return *sources_[part.source]; }
  /// What else than noise may be wrong with these data.
  const Fallible& fallible(const Part& part) const { return source(part).facts().kind.fallible; }
  std::string name_of(const Part& part) const { return source(part).facts().name; }
  /// Root mean square distance of a frame from a lumen, such as the imaged one; infinite if nothing is observed
  /// [length].
  double distance_from(const Points& lumen, const Part& part) const;
  /// Its section in the case.
  std::string field_of(const Part& part) const { return source(part).facts().field(); }
  /// Of the data at the base, where they are; zero for values that are nowhere [length].
  const Eigen::Matrix3Xd& places() const { return places_; }
  /// Of the data on the lumen at the base: n out of the lumen, region (-1: none). Zero for all others.
  const Eigen::Matrix3Xd& normals() const { return normals_; }
  const std::vector<int>& regions() const { return region_; }
  /// Of the data on the lumen, the sum of the imaged lumen's two curvatures there; else zero [1/length].
  const std::vector<double>& curvatures() const { return curvature_; }
  /// Of what is read off an instrument, as it stands there; zero for all others.
  const std::vector<double>& shown() const { return shown_; }
  /// Of all data, in the run.
  const std::vector<double>& times() const { return times_; }
  /// Of the data on the lumen, how far along the vessel they are: 0 at an inlet, 1 at an outlet. Else zero.
  const std::vector<double>& along() const { return along_; }
  const std::vector<std::string>& region_names() const { return region_names_; }
  /// Of the data, which component of a vector they are.
  const std::vector<int>& components() const { return component_; }
  Noise noise(const Part& part) const { return noise_of(part.source); }
  /// A number that frames of the same moment share; of a record its own.
  int moment_of(const Part& part) const;
  std::string field_of_source(std::size_t source) const { return sources_[source]->facts().field(); }
  Noise noise_of(std::size_t source) const { return sources_[source]->facts().noise; }

 private:
  void add(std::size_t number, const MeasuredPart& measured, const FinishedMotion& base);
  void add_datum(const Datum& datum, double deviation);
  double along_vessel(const Datum& datum) const;
  void number_frame(const std::vector<Datum>& data);
  void number_record(const std::vector<Datum>& data);
  std::size_t closest_frame(double time) const;

  std::vector<const Measurement*> sources_;
  const LumenSurface& lumen_;
  VectorXd nodal_curvature_;
  std::vector<std::string> region_names_;
  std::vector<Part> parts_;
  std::vector<double> residual_, precision_, independent_, along_, curvature_, times_, shown_;
  std::vector<bool> held_out_;
  std::vector<int> region_, component_, block_;
  std::vector<Vec3> normal_list_, place_list_;
  Eigen::Matrix3Xd normals_, places_;
  int blocks_ = 0;
};

}  // namespace tether
