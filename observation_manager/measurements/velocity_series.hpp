#pragma once

#include <Eigen/Dense>

#include "observation_manager/measurements/frame_times.hpp"
#include "observation_manager/measurements/measurement.hpp"

namespace tether {

/// Components of velocity: one row a component, one column a point [velocity].
using Components = Eigen::MatrixXd;

/// One moment of a measurement. NaN: not measured at that point.
struct VelocityFrame {
  double time = 0;
  bool held_out = false;
  Components values;
};

/// Velocities measured at points fixed in space, over time.
class VelocitySeries : public Measurement {
 public:
  struct Settings {
    std::string name;
    Eigen::Matrix<double, Eigen::Dynamic, 3> axes;  ///< unit vectors, one row a measured component
    double period = 0, tolerance = 0;               ///< FrameTimes [time]
    Noise noise;                                    ///< of a component
  };
  /// frames: ascending, all with a column for each of `points` (3 x n) [length].
  VelocitySeries(Settings settings, Points points, std::vector<VelocityFrame> frames);

  const Settings& settings() const { return settings_; }
  const Points& points() const { return points_; }
  const std::vector<VelocityFrame>& frames() const { return frames_; }
  /// What of a velocity (3 x n) is measured.
  Components components(const Points& velocity) const { return settings_.axes * velocity; }
  /// Made of the frames around (O.3) that are not held out; nothing at a time without frames.
  std::optional<Components> measured(double time) const;

  MeasurementFacts facts() const override;
  std::uint64_t content() const override;
  Points velocity_points() const override { return points_; }
  std::vector<MeasuredPart> parts(const FinishedMotion& run) const override;
  /// A datum for each point, and each component there.
  std::vector<Datum> data(const FinishedMotion& run, const MeasuredPart& part) const override;
  CountedRows rows(const Points& imaged, double start) const override;
  std::vector<SeenRow> see(const ModelMoment& model, double time) const override;

 private:
  double independent_points() const;
  std::array<int, 4> patch_of(Eigen::Index point) const;

  Settings settings_;
  Points points_;
  std::vector<VelocityFrame> frames_;
  FrameTimes times_;
  mutable double independent_ = 0;  ///< of the points, once it is asked for
};

}  // namespace tether
