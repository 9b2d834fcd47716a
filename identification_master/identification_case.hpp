#pragma once

#include "common/config/fields.hpp"
#include "observation_manager/measurements/faults/allowance.hpp"

namespace tether {

/// One parameter to be found, as a case states it.
struct ParameterCase {
  std::vector<std::string> of;  ///< names that the codes announce; all get the same value
  std::string transform = "announced";
  std::optional<double> mean, deviation;  ///< prior: value in the case's units; of theta
  std::optional<double> lower, upper;     ///< of the value
  double walk = 0;                        ///< of theta [1/sqrt(time)]
  bool factor = false;                    ///< it multiplies the values of the case
  std::string part_of;                    ///< parameter of `prior_from`; empty: that of the same name
  void declare(Fields& f);
};

/// The section `identification` of a case.
struct IdentificationCase {
  Named<ParameterCase> parameters;
  LastingAllowance allowed;
  std::filesystem::path prior_from;  ///< estimate.json; empty: priors are those of the case
  std::string observe = "every_step";
  double reject_beyond = 0, memory_time = 0, largest_shift = 2;
  int groups = 0;
  void declare(Fields& f);
};

/// The columns of estimate.csv that belong to parameters of these names, in order: value, lower, upper of each, theta
/// and its deviation of each, correlations.
std::vector<std::string> columns_of(const std::vector<std::string>& parameters);

}  // namespace tether
