#pragma once

#include <string>
#include <vector>

#include "common/base/transform.hpp"
#include "common/base/types.hpp"
#include "common/config/case_file.hpp"
#include "common/protocol/messages.hpp"
#include "identification_master/earlier_estimate.hpp"
#include "identification_master/identification_case.hpp"
#include "identification_master/results/named_values.hpp"

namespace tether {

/// One parameter to be found: its prior, and the model's numbers that it sets.
struct IdentifiedParameter {
  struct Target {
    std::string name;
    double scale;  ///< of the parameter: the case's value if the parameter is a factor, else 1
  };
  std::string name, unit;  ///< unit "1" for a factor
  std::vector<Target> targets;
  Transform transform = Transform::linear;
  Range range;  ///< of the value: the case's bounds, and what the model admits of all targets
  double prior_mean = 0, prior_deviation = 0;  ///< of theta
  double walk = 0;                             ///< of theta [1/sqrt(time)]
  std::optional<Eigen::Index> mother;          ///< number of the earlier parameter that it begins from

  /// What the model is told for a theta: within the range, whatever the theta.
  double value(double theta) const;
  /// Whether the value of a theta had to be moved into the range.
  bool is_moved(double theta) const;
};

/// The parameters of an identification, in the order of the case.
class IdentifiedParameters {
 public:
  /// announced: what the codes say that can be set. Throws InputError that names the field: unknown number (with the
  /// nearest known one), no prior, a mean that transform or bounds do not admit, a deviation that cannot be told in the
  /// parameter's own terms, one number in two parameters.
  IdentifiedParameters(const IdentificationCase& given, const std::vector<protocol::ParameterInfo>& announced,
                       const CaseFile& file);

  const std::vector<IdentifiedParameter>& list() const { return list_; }
  VectorXd prior_mean() const;
  VectorXd prior_variances() const;
  /// With what an earlier identification knew of several together. (K.9)
  MatrixXd prior_covariance() const;
  /// Added to the variances of theta in a step of dt.
  VectorXd walked(double dt) const;
  /// What the model is told for a theta [p]. What the bounds do not admit is moved to the nearest admissible value.
  NamedValues values_at(const VectorXd& theta) const;
  /// The same, and counts what was moved.
  NamedValues values(const VectorXd& theta) const;
  /// Values that were moved into their range so far.
  int moved() const { return moved_; }

 private:
  std::vector<IdentifiedParameter> list_;
  EarlierEstimate earlier_;
  mutable int moved_ = 0;
};

}  // namespace tether
