#include "identification_master/identification_case.hpp"

#include <fmt/format.h>

#include <set>

namespace tether {
namespace {

/// What is wrong with the names that a case gives its parameters; empty: nothing.
std::string fault_of(const std::vector<std::string>& names) {
  std::set<std::string> seen{"time",     "data",      "chi_square", "expected_chi_square",
                             "rejected", "tempering", "evaluations"};
  for (const std::string& column : columns_of(names))
    if (!seen.insert(column).second)
      return fmt::format("two columns of estimate.csv would be called \"{}\"; choose other names", column);
  return {};
}

}  // namespace

std::vector<std::string> columns_of(const std::vector<std::string>& parameters) {
  std::vector<std::string> columns;
  for (const std::string& name : parameters)
    for (const char* part : {"", ".lower", ".upper"}) columns.push_back(name + part);
  for (const std::string& name : parameters)
    for (const char* part : {".theta", ".theta_deviation"}) columns.push_back(name + part);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      columns.push_back(fmt::format("correlation.{}.{}", parameters[j], parameters[i]));
  return columns;
}

void ParameterCase::declare(Fields& f) {
  f.texts(
      "of", of,
      "the model's numbers that this parameter sets, by their place in the case: solid.support.regions.spine.stiffness",
      Need::required);
  f.choice("transform", transform,
           {{"announced", "as the model announces for the first of them"},
            {"linear", "theta is the value"},
            {"log", "theta is its natural logarithm: always positive"},
            {"log2", "theta is its logarithm to base 2: a step of 1 is a factor of two"},
            {"bounded", "theta is the logit of its place between lower and upper"}},
           "what is assumed to be normally distributed");
  f.number("mean", mean, dimension::none, range::any,
           "value before the data, in the case's units; absent: that of the case");
  f.number("deviation", deviation, dimension::none, range::positive,
           "standard deviation before the data, of theta; absent: as the model announces, told in this theta at the "
           "mean; of "
           "one that begins from prior_from: about what that knew, absent: 0");
  f.number("lower", lower, dimension::none, range::any,
           "smallest admissible value, in the case's units; absent: that of the model");
  f.number("upper", upper, dimension::none, range::any, "largest admissible value");
  f.number("walk", walk, dimension::none, range::not_negative,
           "the parameter changes in time: standard deviation of theta after one unit of time without data");
  f.flag("factor", factor, "the parameter is a factor: each number keeps its value of the case, times it");
  f.text("part_of", part_of,
         "parameter of prior_from whose region was divided into this one and others: this one begins from it; absent: "
         "from the one of the same name, if there is one");
  f.check(!of.empty(), "of", "must name at least one number");
  f.check(!lower || !upper || *lower < *upper, "upper", "must be above lower");
}

void IdentificationCase::declare(Fields& f) {
  f.groups("parameters", parameters, "what is to be found, by names of your choice");
  std::vector<std::string> names;
  for (const auto& [name, parameter] : parameters) names.push_back(name);
  const std::string fault = fault_of(names);
  f.check(fault.empty(), "parameters", fault);
  f.path("prior_from", prior_from,
         "estimate.json of an earlier identification: mean and covariance that it ended with are the prior of "
         "parameters of the same name, and of parts");
  f.group("allowed", allowed,
          "standard deviations of what the data may be off by in all frames alike, a region (model) once more in each "
          "frame, which is found beside the parameters (K.8); 0: nothing");
  f.choice("observe", observe,
           {{"every_step", "between frames too, by a curve through those around; each frame counts once in all"},
            {"frames", "each series, and each value of a trace, counts only in the step that ends nearest to it"},
            {"never", "nothing is corrected: only what the data would tell is written, with all sensitivities"}},
           "when the model is corrected");
  f.number("reject_beyond", reject_beyond, dimension::none, range::not_negative,
           "data whose distance exceeds its predicted standard deviation by this factor are left out; 0: none are");
  f.number("memory_time", memory_time, dimension::time, range::not_negative,
           "what was learned loses weight as exp(-t/memory_time), down to what was known before; 0: it does not");
  f.number(
      "largest_shift", largest_shift, dimension::none, range::positive,
      "of the parameters in one correction, in their standard deviations; beyond, its data get less weight for good");
  f.integer("groups", groups, {0, 10000},
            "groups of processes that share the particles; 0: one for each core as far as memory goes, at most as many "
            "as there are particles");
}

}  // namespace tether
