#include "diagnosis/search/further_measurement.hpp"

#include <algorithm>

namespace tether {
namespace {

using Index = Eigen::Index;

/// Training data on top of the new ones.
struct Joint {
  Joint(const EffectProblem& problem, const FurtherMeasurement* measurement)
      : problem_(problem), measurement_(measurement), old_(static_cast<Index>(problem.training.size())) {
    new_ = measurement == nullptr ? 0 : measurement->values.rows();
  }
  VectorXd stacked(const VectorXd& old, const VectorXd& other) const {
    VectorXd all(old_ + new_);
    all << old(problem_.training), other;
    return all;
  }
  /// How two runs differ in the new data.
  VectorXd between(Index run, Index other) const {
    return new_ == 0 ? VectorXd(0) : VectorXd(measurement_->values.col(run) - measurement_->values.col(other));
  }
  AllowedErrors allowed() const {
    const double factor = measurement_ == nullptr ? 1 : measurement_->precision_factor;
    const VectorXd precision = stacked(factor * problem_.precision, new_ == 0 ? VectorXd(0) : measurement_->precision);
    MatrixXd columns = MatrixXd::Zero(old_ + new_, problem_.allowed.cols());
    columns.topRows(old_) = problem_.allowed(problem_.training, Eigen::all);
    for (const AllowedRun& input : problem_.allowed_runs)
      if (new_ > 0) columns.col(input.column).tail(new_) = between(input.run, 0) / input.step;
    return {precision, columns, problem_.allowed_deviation};
  }

 private:
  const EffectProblem& problem_;
  const FurtherMeasurement* measurement_;
  Index old_, new_ = 0;
};

/// What is left of `difference` if a multiple of `scaled` is taken away.
double left(const AllowedErrors& allowed, const VectorXd& difference, const VectorXd& scaled) {
  const VectorXd d = allowed(difference).col(0), s = allowed(scaled).col(0);
  const double square = scaled.dot(s), along = scaled.dot(d);
  return std::max(0.0, difference.dot(d) - (square > 0 ? along * along / square : 0));
}

}  // namespace

double expected_difference(const EffectProblem& problem, const Rivals& rivals, const FurtherMeasurement* measurement) {
  const Joint joint(problem, measurement);
  const AllowedErrors allowed = joint.allowed();
  const VectorXd difference =
      joint.stacked(rivals.other_residual - rivals.residual, joint.between(rivals.run, rivals.other_run));
  const VectorXd one = joint.stacked(problem.residual - rivals.residual, joint.between(rivals.run, rivals.base)),
                 other = joint.stacked(problem.residual - rivals.other_residual,
                                       joint.between(rivals.other_run, rivals.base));
  if (one.isZero() || other.isZero()) return difference.dot(allowed(difference).col(0));
  return std::min(left(allowed, difference, one), left(allowed, difference, other));
}

std::vector<Split> splits(const EffectProblem& problem, const std::vector<Rivals>& rivals,
                          const std::vector<FurtherMeasurement>& measurements) {
  std::vector<Split> all;
  for (const FurtherMeasurement& measurement : measurements) {
    double least = infinite;
    for (const Rivals& pair : rivals) least = std::min(least, expected_difference(problem, pair, &measurement));
    all.push_back({measurement.name, measurement.assuming, least});
  }
  std::stable_sort(all.begin(), all.end(), [](const Split& a, const Split& b) { return a.difference > b.difference; });
  return all;
}

}  // namespace tether
