#include "identification_master/earlier_estimate.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

/// To the digits that a record has.
bool is_covariance(const MatrixXd& matrix) {
  constexpr double digits = 1e-9;
  if (!matrix.allFinite() || (matrix - matrix.transpose()).norm() > digits * matrix.norm()) return false;
  const VectorXd variances = matrix.selfadjointView<Eigen::Lower>().eigenvalues();
  return matrix.size() == 0 || variances.minCoeff() >= -digits * variances.maxCoeff();
}

Estimate estimate_in(const std::filesystem::path& file) {
  try {
    return read_record<Estimate>(file);
  } catch (const InputError& error) {
    throw input_error("identification.prior_from: must be the estimate.json of an identification: {}", error.what());
  }
}

}  // namespace

EarlierEstimate::EarlierEstimate(const std::filesystem::path& file) : told_(estimate_in(file)) {
  if (!told_.corrected)
    throw input_error("{}: is of an identification that corrected nothing (observe: never)", file.string());
  const auto count = std::ssize(told_.parameters);
  if (told_.covariance_of_theta.rows() != count || told_.covariance_of_theta.cols() != count)
    throw input_error("{}: covariance_of_theta is not that of {} parameters", file.string(), count);
  if (!is_covariance(told_.covariance_of_theta))
    throw input_error("{}: covariance_of_theta is no covariance: it is to be symmetric, with no negative variance",
                      file.string());
  for (const EstimatedParameter& parameter : told_.parameters)
    if (!std::isfinite(parameter.estimate.theta))
      throw input_error("{}: the estimate of {} has no theta", file.string(), parameter.name);
}

std::optional<Eigen::Index> EarlierEstimate::find(const std::string& name) const {
  for (Eigen::Index i = 0; i < std::ssize(told_.parameters); ++i)
    if ((*this)[i].name == name) return i;
  return std::nullopt;
}

std::vector<std::string> EarlierEstimate::names() const {
  std::vector<std::string> all;
  for (const EstimatedParameter& parameter : told_.parameters) all.push_back(parameter.name);
  return all;
}

EarlierEstimate earlier_of(const IdentificationCase& given) {
  return given.prior_from.empty() ? EarlierEstimate() : EarlierEstimate(given.prior_from);
}

}  // namespace tether
