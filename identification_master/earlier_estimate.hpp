#pragma once

#include <filesystem>
#include <optional>

#include "identification_master/identification_case.hpp"
#include "identification_master/results/estimate.hpp"

namespace tether {

/// What an earlier identification found, as the beginning of another one. (K.9)
class EarlierEstimate {
 public:
  EarlierEstimate() = default;
  /// Throws InputError if the file is no estimate, or one that corrected nothing.
  explicit EarlierEstimate(const std::filesystem::path& file);

  /// The number of a parameter; nothing if there is none of this name.
  std::optional<Eigen::Index> find(const std::string& name) const;
  const EstimatedParameter& operator[](Eigen::Index i) const { return told_.parameters[static_cast<std::size_t>(i)]; }
  std::vector<std::string> names() const;
  double covariance(Eigen::Index i, Eigen::Index j) const { return told_.covariance_of_theta(i, j); }

 private:
  Estimate told_;
};

/// Of a case's prior_from; of nothing if it has none.
EarlierEstimate earlier_of(const IdentificationCase& given);

}  // namespace tether
