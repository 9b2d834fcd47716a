#include "identification_master/identified_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

using protocol::ParameterInfo;

const ParameterInfo& find(const std::vector<ParameterInfo>& announced, const std::string& name,
                          const std::string& where) {
  std::vector<std::string> known;
  for (const ParameterInfo& info : announced) {
    if (info.name == name) return info;
    known.push_back(info.name);
  }
  const std::string near = nearest(name, known);
  throw input_error("{}: the model has no number {}; {}", where, name,
                    near.empty() ? "it has " + listed(known) : fmt::format("did you mean {}?", near));
}

Range narrowed(Range range, const ParameterCase& given) {
  if (given.lower) range.lower = std::max(range.lower, *given.lower);
  if (given.upper) range.upper = std::min(range.upper, *given.upper);
  return range;
}

/// Builds one parameter of a case from what the model announces.
class Builder {
 public:
  Builder(const std::string& name, const ParameterCase& given, const std::vector<ParameterInfo>& announced,
          const CaseFile& file)
      : given_(given),
        path_("identification.parameters." + name),
        file_(file),
        first_(find(announced, given.of.front(), where("of"))) {
    made_.name = name;
    made_.unit = given.factor ? "1" : first_.unit;
    made_.walk = given.walk;
    for (const std::string& target : given.of) add(find(announced, target, where("of")));
    made_.transform = transform_named(given.transform == "announced" ? first_.transform : given.transform);
    made_.range = narrowed(given.factor ? Range{} : Range{first_.lower, first_.upper}, given);
    set_prior();
  }
  IdentifiedParameter take() { return std::move(made_); }

 private:
  std::string where(const char* field) const { return file_.where(path_ + "." + field); }

  void add(const ParameterInfo& info) {
    if (!given_.factor && info.unit != first_.unit)
      throw input_error("{}: {} is in {}, {} in {}: one parameter cannot set both", where("of"), first_.name,
                        first_.unit, info.name, info.unit);
    made_.targets.push_back({info.name, given_.factor ? info.value : 1, {info.lower, info.upper}});
  }
  void set_prior() {
    if (made_.transform == Transform::bounded &&
        !(std::isfinite(made_.range.lower) && std::isfinite(made_.range.upper)))
      throw input_error("{}: must be given for a bounded parameter, and upper too", where("lower"));
    const double mean = given_.mean.value_or(given_.factor ? 1 : usual_value());
    try {
      made_.prior_mean = stretched(made_.transform, mean, made_.range);
    } catch (const InputError& error) {
      throw input_error("{}: {}{}", where("mean"), error.what(), given_.mean ? "" : " (the case's value; give a mean)");
    }
    made_.prior_deviation = given_.deviation.value_or(first_.prior_deviation);
    if (!(made_.prior_deviation > 0))
      throw input_error("{}: must be given: the model announces none for {}", where("deviation"), first_.name);
  }

  /// The case's value; of an effect that is absent, and has no logarithm there, the scale that the model announces.
  double usual_value() const {
    const bool logarithmic = made_.transform == Transform::log || made_.transform == Transform::log2;
    return logarithmic && first_.value == 0 && first_.scale > 0 ? first_.scale : first_.value;
  }

  const ParameterCase& given_;
  std::string path_;
  const CaseFile& file_;
  const ParameterInfo& first_;
  IdentifiedParameter made_;
};

void check_overlap(const std::vector<IdentifiedParameter>& list, const CaseFile& file) {
  std::vector<std::pair<std::string, std::string>> seen;  // number, parameter
  for (const IdentifiedParameter& parameter : list)
    for (const auto& target : parameter.targets) {
      for (const auto& [number, owner] : seen)
        if (number == target.name)
          throw input_error("{}: {} is already set by {}",
                            file.where("identification.parameters." + parameter.name + ".of"), number, owner);
      seen.emplace_back(target.name, parameter.name);
    }
}

/// An admissible value: `value`, or one that is a thousandth of the way from the range's end to a value `inside`.
double admissible(const Range& range, double value, double inside) {
  constexpr double share = 1e-3;
  if (value <= range.lower && value < inside) return range.lower + share * (inside - range.lower);
  if (value >= range.upper && value > inside) return range.upper - share * (range.upper - inside);
  return value;
}

}  // namespace

double IdentifiedParameter::value(double theta) const {
  return unstretched(transform, theta, range);
}

IdentifiedParameters::IdentifiedParameters(const IdentificationCase& given, const std::vector<ParameterInfo>& announced,
                                           const CaseFile& file) {
  if (given.parameters.empty())
    throw input_error("{}: names no parameters to be found", file.where("identification.parameters"));
  for (const auto& [name, parameter] : given.parameters)
    list_.push_back(Builder(name, parameter, announced, file).take());
  check_overlap(list_, file);
}

VectorXd IdentifiedParameters::prior_mean() const {
  VectorXd mean(list_.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i) mean(i) = list_[static_cast<std::size_t>(i)].prior_mean;
  return mean;
}

VectorXd IdentifiedParameters::prior_variances() const {
  VectorXd variances(list_.size());
  for (Eigen::Index i = 0; i < variances.size(); ++i)
    variances(i) = std::pow(list_[static_cast<std::size_t>(i)].prior_deviation, 2);
  return variances;
}

VectorXd IdentifiedParameters::walked(double dt) const {
  VectorXd variances(list_.size());
  for (Eigen::Index i = 0; i < variances.size(); ++i)
    variances(i) = std::pow(list_[static_cast<std::size_t>(i)].walk, 2) * dt;
  return variances;
}

NamedValues IdentifiedParameters::values(const VectorXd& theta) const {
  NamedValues all;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const IdentifiedParameter& parameter = list_[i];
    const double value = parameter.value(theta(static_cast<Eigen::Index>(i))),
                 prior = parameter.value(parameter.prior_mean), kept = admissible(parameter.range, value, prior);
    bool was_moved = kept != value;
    for (const auto& target : parameter.targets) {
      const double wanted = kept * target.scale, admitted = admissible(target.range, wanted, prior * target.scale);
      was_moved = was_moved || admitted != wanted;
      all.names.push_back(target.name);
      all.values.push_back(admitted);
    }
    moved_ += was_moved ? 1 : 0;
  }
  return all;
}

}  // namespace tether
