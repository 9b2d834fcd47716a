#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "common/io/record.hpp"

/// What an identification found, as estimate.json has it (docs/identification.md). Other rooms read it by this.
namespace tether {

/// Beside it, to go on with: the case with what was found.
inline constexpr const char* identified_file = "identified.yaml";

struct EstimateRange {
  static constexpr const char* type_name = "estimate_range";
  double value = 0, lower = 0, upper = 0;
  double theta = 0, theta_deviation = 0;

  static void fields(auto& self, auto&& field) {
    field("value", self.value, "median, in the parameter's unit");
    field("lower_95", self.lower, "of its 95 % interval");
    field("upper_95", self.upper, "of its 95 % interval");
    field("theta", self.theta, "mean of the transformed parameter");
    field("theta_deviation", self.theta_deviation, "its standard deviation");
  }
};

/// A number of the model that a parameter sets.
struct EstimatedNumber {
  static constexpr const char* type_name = "estimated_number";
  std::string name;
  double value = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "by its place in the case");
    field("value", self.value, "by the estimate");
  }
};

/// The bound that holds an estimate back.
enum class Bound { lower, upper };

template <>
inline constexpr auto words_of<Bound> = std::to_array<WordOf<Bound>>({
    {Bound::lower, "lower", "the smallest value that it may have"},
    {Bound::upper, "upper", "the largest value that it may have"},
});

struct EstimatedParameter {
  static constexpr const char* type_name = "estimated_parameter";
  std::string name;
  std::vector<EstimatedNumber> sets;
  std::string unit, transform;
  EstimateRange prior, estimate;
  std::optional<Bound> at_bound;
  double retained_information = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("sets", self.sets, "numbers of the model that it stands for");
    field("unit", self.unit, "of the values; 1: none");
    field("transform", self.transform, "of the value to theta");
    field("prior", self.prior, "before the data");
    field("estimate", self.estimate, "after the data");
    field("at_bound", self.at_bound, "the bound that holds it back");
    field("retained_information", self.retained_information, "share that the other parameters do not explain as well");
  }
};

/// An error of the data that is the same in all frames, as it was found beside the parameters.
struct LastingErrorTold {
  static constexpr const char* type_name = "lasting_error";
  std::string source, name;
  double allowed = 0, value = 0, deviation = 0;

  static void fields(auto& self, auto&& field) {
    field("source", self.source, "the data, by their place in the case");
    field("name", self.name, "bias: along the normal; x, y, z: displacement; a region: the model's own");
    field("allowed", self.allowed, "deviation before the data [length]");
    field("value", self.value, "by which these data lie farther out, or along that axis [length]");
    field("deviation", self.deviation, "of it, after the data [length]");
  }
};

/// Directions in the space of the parameters, by how much the data say of them.
struct IdentifiabilityTold {
  static constexpr const char* type_name = "identifiability";
  MatrixXd gramian;
  std::vector<double> information;
  MatrixXd directions;

  static void fields(auto& self, auto&& field) {
    field("gramian", self.gramian, "information of the data in deviations of the prior");
    field("information", self.information, "its eigenvalues");
    field("directions", self.directions, "a row for each of them");
  }
};

/// How well the filter foretold the data.
struct InnovationsTold {
  static constexpr const char* type_name = "innovations";
  double effective_data = 0, used_data = 0, chi_square = 0, expected_chi_square = 0, chi_square_per_datum = 0;
  double autocorrelation = 0, rejected_share = 0;
  int tempered_steps = 0;

  static void fields(auto& self, auto&& field) {
    field("effective_data", self.effective_data, "number of independent data");
    field("used_data", self.used_data, "of these, with tempering");
    field("chi_square", self.chi_square, "of the innovations");
    field("expected_chi_square", self.expected_chi_square, "if model and noise are right");
    field("chi_square_per_datum", self.chi_square_per_datum, "of effective data");
    field("autocorrelation_between_frames", self.autocorrelation, "of the innovations");
    field("rejected_share", self.rejected_share, "of the data, as outliers");
    field("tempered_steps", self.tempered_steps, "in which a correction was weakened");
  }
};

struct EstimateCost {
  static constexpr const char* type_name = "identification_cost";
  int particles = 0, groups = 0;
  double wall_seconds = 0, cpu_seconds = 0, master_loop_cpu_seconds = 0, peak_memory_mb = 0;

  static void fields(auto& self, auto&& field) {
    field("particles", self.particles, "of the filter");
    field("groups", self.groups, "of processes");
    field("wall_seconds", self.wall_seconds, "[s]");
    field("cpu_seconds", self.cpu_seconds, "of all processes [s]");
    field("master_loop_cpu_seconds", self.master_loop_cpu_seconds, "[s]");
    field("peak_memory_mb", self.peak_memory_mb, "of all processes [MB]");
  }
};

struct Estimate {
  static constexpr const char* type_name = "estimate";
  std::string case_name, title, case_file;
  double time = 0;
  std::int64_t steps = 0;
  bool corrected = false;
  std::vector<EstimatedParameter> parameters;
  MatrixXd correlations, covariance_of_theta;
  std::vector<LastingErrorTold> lasting_errors;
  IdentifiabilityTold identifiability;
  InnovationsTold innovations;
  std::int64_t values_moved_into_their_range = 0;
  std::vector<std::string> notices;
  EstimateCost cost;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_name, "name of the case");
    field("title", self.title, "of the case");
    field("case_file", self.case_file, "as it was given");
    field("time", self.time, "of the last data [s]");
    field("steps", self.steps, "of the run");
    field("corrected", self.corrected, "whether the data corrected the parameters; else what they would tell");
    field("parameters", self.parameters, "in the case's order");
    field("correlations", self.correlations, "of the parameters' theta");
    field("covariance_of_theta", self.covariance_of_theta, "after the data");
    field("lasting_errors", self.lasting_errors, "of the data, the same in all frames");
    field("identifiability", self.identifiability, "what the data say");
    field("innovations", self.innovations, "how well the data were foretold");
    field("values_moved_into_their_range", self.values_moved_into_their_range, "of all particles and steps");
    field("notices", self.notices, "what the programs remarked");
    field("cost", self.cost, "of the identification");
  }
};

}  // namespace tether
