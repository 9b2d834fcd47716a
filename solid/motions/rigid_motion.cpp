#include "solid/motions/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common/base/curve.hpp"
#include "common/base/error.hpp"
#include "common/base/periodic_fit.hpp"

namespace tether {
namespace {

Mat3 rotation_by(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3(Mat3::Identity());
}

Vec3 turn_of(const Mat3& rotation) {
  const Eigen::AngleAxisd axis(rotation);
  return axis.angle() * axis.axis();
}

/// Points whose second spread is less than this part of the first lie on a line.
constexpr double least_spread = 1e-3;

void check_not_on_a_line(const Points& centred) {
  const Vec3 spreads = Eigen::JacobiSVD<Points>(centred).singularValues();
  if (!(spreads[1] > least_spread * spreads[0]))
    throw input_error("the points lie on a line: how it turns about it cannot be seen");
}

}  // namespace

Poses poses_of(std::vector<double> times, const std::vector<Points>& marks) {
  TETHER_ASSERT(times.size() == marks.size(), "{} times, {} sets of points", times.size(), marks.size());
  Poses poses{std::move(times), {}, {}};
  const auto count = static_cast<Eigen::Index>(marks.size());
  poses.centres.resize(3, count);
  poses.turns.resize(3, count);
  const Points first = marks.front().colwise() - marks.front().rowwise().mean();
  check_not_on_a_line(first);
  double sum = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Points& now = marks[static_cast<std::size_t>(k)];
    poses.centres.col(k) = now.rowwise().mean();
    const Points centred = now.colwise() - poses.centres.col(k);
    const Mat3 rotation = Eigen::umeyama(first, centred, false).topLeftCorner<3, 3>();
    poses.turns.col(k) = turn_of(rotation);
    sum += (centred - rotation * first).colwise().squaredNorm().mean();
  }
  poses.misfit = std::sqrt(sum / static_cast<double>(count));
  return poses;
}

RigidMotion::RigidMotion(const Poses& poses, const MotionShape& shape, const Placement& placement)
    : placement_(placement), point_misfit_(poses.misfit) {
  const double most = poses.turns.colwise().norm().maxCoeff();
  if (shape.turns && most > std::numbers::pi / 2)
    throw input_error(
        "the body turns by {:.0f} degrees: are its points the same ones, in the same order, at all times?",
        most * 180 / std::numbers::pi);
  centre_ = smooth(poses.times, poses.centres, shape, centre_residual_);
  turn_ = [](double) -> Vec3 { return Vec3::Zero(); };
  if (shape.turns) turn_ = smooth(poses.times, poses.turns, shape, turn_residual_);
  start_ = centre_(0);
  start_turned_ = rotation_by(turn_(0));
  for (const double time : poses.times) largest_way_ = std::max(largest_way_, (centre_(time) - start_).norm());
}

RigidMotion::Path RigidMotion::smooth(const std::vector<double>& times, const Points& values, const MotionShape& shape,
                                      double& residual) const {
  if (shape.harmonics) {
    TETHER_ASSERT(shape.period.has_value(), "harmonics without a period");
    const auto fit = std::make_shared<const PeriodicFit>(times, values, *shape.period, *shape.harmonics);
    residual = fit->residual();
    return [fit](double time) -> Vec3 { return (*fit)(time); };
  }
  std::vector<Curve> curves;
  for (const auto& row : values.rowwise())
    curves.emplace_back(times, std::vector<double>(row.begin(), row.end()),
                        CurveShape{.period = shape.period.value_or(0.0)});
  return [curves](double time) -> Vec3 { return {curves[0](time), curves[1](time), curves[2](time)}; };
}

/// x -> c(t) + R(t) R(0)' (x - c(0)), in the model's frame. (S.23)
AffineDisplacement RigidMotion::operator()(double time) const {
  const Mat3& Q = placement_.rotation;
  const Mat3 turned = rotation_by(turn_(time)) * start_turned_.transpose();
  AffineDisplacement result;
  result.gradient = Q * (turned - Mat3::Identity()) * Q.transpose();
  result.offset = Q * (centre_(time) - start_) - result.gradient * placement_.centre.value_or(Q * start_);
  return result;
}

}  // namespace tether
