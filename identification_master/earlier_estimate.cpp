#include "identification_master/earlier_estimate.hpp"

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"

namespace tether {

EarlierEstimate::EarlierEstimate(const std::filesystem::path& file) : told_(read_record<Estimate>(file)) {
  if (!told_.corrected)
    throw input_error("{}: is of an identification that corrected nothing (observe: never)", file.string());
  const auto count = std::ssize(told_.parameters);
  if (told_.covariance_of_theta.rows() != count || told_.covariance_of_theta.cols() != count)
    throw input_error("{}: covariance_of_theta is not that of {} parameters", file.string(), count);
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
