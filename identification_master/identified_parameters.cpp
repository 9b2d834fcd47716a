#include "identification_master/identified_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/parameter_table.hpp"
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

/// What the model admits of a number, for a parameter that times `scale` is that number.
Range admitted(const ParameterInfo& info, double scale) {
  if (scale == 0) return {};
  const double one = info.lower / scale, other = info.upper / scale;
  return {std::min(one, other), std::max(one, other)};
}

Range common(const Range& a, const Range& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

bool is_logarithmic(Transform transform) {
  return transform == Transform::log || transform == Transform::log2;
}

/// Change of the value with theta.
double slope(Transform transform, double value, const Range& range) {
  switch (transform) {
    case Transform::log:
      return value;
    case Transform::log2:
      return value * std::log(2.0);
    case Transform::bounded:
      return (value - range.lower) * (range.upper - value) / (range.upper - range.lower);
    case Transform::linear:
      break;
  }
  return 1;
}

/// Builds one parameter of a case from what the model announces.
class Builder {
 public:
  Builder(const std::string& name, const ParameterCase& given, const std::vector<ParameterInfo>& announced,
          const EarlierEstimate& earlier, const CaseFile& file)
      : given_(given),
        path_("identification.parameters." + name),
        file_(file),
        first_(find(announced, given.of.front(), where("of"))) {
    made_.name = name;
    made_.unit = given.factor ? "1" : first_.unit;
    made_.walk = given.walk;
    made_.transform = transform_named(given.transform == "announced" ? first_.transform : given.transform);
    for (const std::string& target : given.of) add(find(announced, target, where("of")));
    bound();
    made_.mother = mother_in(earlier);
    made_.mother ? begin_from(earlier[*made_.mother], earlier.covariance(*made_.mother, *made_.mother)) : begin();
    check_reach("deviation", made_.prior_deviation);
    check_walk();
  }
  IdentifiedParameter take() { return std::move(made_); }

 private:
  std::string where(const char* field) const { return file_.where(path_ + "." + field); }

  void add(const ParameterInfo& info) {
    if (!given_.factor && info.unit != first_.unit)
      throw input_error("{}: {} is in {}, {} in {}: one parameter cannot set both", where("of"), first_.name,
                        first_.unit, info.name, info.unit);
    if (given_.factor && info.value == 0)
      throw input_error("{}: {} is 0 in the case, and stays 0 whatever the factor", where("of"), info.name);
    made_.targets.push_back({info.name, given_.factor ? info.value : 1});
    made_.range = common(made_.range, admitted(info, made_.targets.back().scale));
  }
  void bound() {
    const Range model = made_.range;
    made_.range = common(model, {given_.lower.value_or(-infinite), given_.upper.value_or(infinite)});
    if (!(made_.range.lower < made_.range.upper))
      throw input_error("{}: the model admits {} to {} only", where(given_.lower ? "lower" : "upper"), model.lower,
                        model.upper);
    if (made_.transform == Transform::bounded &&
        !(std::isfinite(made_.range.lower) && std::isfinite(made_.range.upper)))
      throw input_error("{}: must be given for a bounded parameter, and upper too", where("lower"));
  }
  void begin() {
    made_.prior_mean = theta_of(mean_ = given_.mean.value_or(given_.factor ? 1 : usual_value()));
    made_.prior_deviation = given_.deviation ? *given_.deviation : announced_deviation();
    check_is_seen();
  }
  std::optional<Eigen::Index> mother_in(const EarlierEstimate& earlier) const {
    if (given_.part_of.empty()) return earlier.find(made_.name);
    if (const auto mother = earlier.find(given_.part_of)) return mother;
    const std::vector<std::string> known = earlier.names();
    if (known.empty())
      throw input_error("{}: {}: is of an earlier identification: give its estimate.json as identification.prior_from",
                        where("part_of"), given_.part_of);
    throw input_error("{}: identification.prior_from has no parameter {}; it has {}", where("part_of"), given_.part_of,
                      listed(known));
  }
  /// From what an earlier identification knew of it, or of the whole that it is a part of. (K.9)
  void begin_from(const EstimatedParameter& mother, double variance) {
    if (given_.mean)
      throw input_error("{}: must be absent: identification.prior_from has it ({})", where("mean"), mother.name);
    if (!given_.part_of.empty() && !given_.deviation)
      throw input_error("{}: must be given: how far a part may be from the whole", where("deviation"));
    if (mother.transform != name_of(made_.transform) || mother.unit != made_.unit)
      throw input_error("{}: {} is the {} of a number in {}, and was the {} of one in {} in identification.prior_from",
                        where("transform"), made_.name, name_of(made_.transform), made_.unit, mother.transform,
                        mother.unit);
    if (const double theta = theta_of(mother.estimate.value);
        made_.transform == Transform::bounded && std::abs(theta - mother.estimate.theta) > 1e-6)
      throw input_error("{}: must be what it was in identification.prior_from: theta depends on it", where("lower"));
    made_.prior_mean = mother.estimate.theta;
    made_.prior_deviation = std::sqrt(variance + std::pow(given_.deviation.value_or(0), 2));
  }
  double theta_of(double mean) const {
    const char* whose = given_.mean ? "" : " (the case's value; give a mean)";
    if (is_logarithmic(made_.transform) && !(mean > 0))
      throw input_error("{}: {} has no logarithm{}", where("mean"), mean, whose);
    if (!(mean > made_.range.lower && mean < made_.range.upper))
      throw input_error("{}: {} is not between the bounds {} and {}{}", where("mean"), mean, made_.range.lower,
                        made_.range.upper, whose);
    return stretched(made_.transform, mean, made_.range);
  }

  /// The deviation that the model announces, in the number's own theta, is that of this parameter's theta at the mean.
  double announced_deviation() const {
    if (!(first_.prior_deviation > 0))
      throw input_error("{}: must be given: the model announces none for {}", where("deviation"), first_.name);
    const double scale = made_.targets.front().scale;
    const Transform own = transform_named(first_.transform);
    const double of_value =
        first_.prior_deviation * std::abs(slope(own, mean_ * scale, {first_.lower, first_.upper}) / scale);
    const double deviation = of_value / slope(made_.transform, mean_, made_.range);
    const bool is_converted = own != made_.transform || given_.factor;
    const bool reaches = made_.transform == Transform::linear &&
                         (mean_ - deviation <= made_.range.lower || mean_ + deviation >= made_.range.upper);
    if (!std::isfinite(deviation) || (is_converted && reaches))
      throw input_error(
          "{}: must be given: what the model announces for {}, {} of its {}, reaches beyond the bounds {} and {} if "
          "the "
          "transform is {}",
          where("deviation"), first_.name, first_.prior_deviation, first_.transform, made_.range.lower,
          made_.range.upper, name_of(made_.transform));
    return deviation;
  }

  /// Particles a deviation apart must be different numbers, and its square one that can be divided by.
  void check_is_seen() const {
    constexpr double share = 1e-9, tiny = 1e-30;
    const double least = std::max(share * std::abs(made_.prior_mean), tiny);
    if (made_.prior_deviation < least)
      throw input_error("{}: {} of the {} is too small: its mean there is {:.6g}: must be at least {:.3g}",
                        where("deviation"), made_.prior_deviation,
                        made_.transform == Transform::linear ? "value" : name_of(made_.transform), made_.prior_mean,
                        least);
  }

  /// What is known at first would be nothing against it; and after one unit of time the value must still be a number.
  void check_walk() const {
    constexpr double most = 1e3;  // of the deviation
    if (given_.walk > most * made_.prior_deviation)
      throw input_error("{}: {} is too large: must be at most {:.3g}, a thousand deviations before the data",
                        where("walk"), given_.walk, most * made_.prior_deviation);
    check_reach("walk", given_.walk);
  }

  /// Two deviations from the mean there must still be numbers.
  void check_reach(const char* field, double deviation) const {
    for (const double side : {-2.0, 2.0}) {
      const double value = unstretched(made_.transform, made_.prior_mean + side * deviation, made_.range);
      if (!std::isfinite(value) || (is_logarithmic(made_.transform) && !(value > 0)))
        throw input_error("{}: {} of the {} is too large: two deviations from the mean the value would be {}",
                          where(field), deviation,
                          made_.transform == Transform::linear ? "value" : name_of(made_.transform), value);
    }
  }

  /// The case's value; of an effect that is absent, and has no logarithm there, the scale that the model announces.
  double usual_value() const {
    return is_logarithmic(made_.transform) && first_.value == 0 && first_.scale > 0 ? first_.scale : first_.value;
  }

  const ParameterCase& given_;
  std::string path_;
  const CaseFile& file_;
  const ParameterInfo& first_;
  double mean_ = 0;  ///< value before the data
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
  return admissible(range, unstretched(transform, theta, range), unstretched(transform, prior_mean, range));
}

bool IdentifiedParameter::is_moved(double theta) const {
  return value(theta) != unstretched(transform, theta, range);
}

IdentifiedParameters::IdentifiedParameters(const IdentificationCase& given, const std::vector<ParameterInfo>& announced,
                                           const CaseFile& file) {
  if (given.parameters.empty())
    throw input_error("{}: names no parameters to be found", file.where("identification.parameters"));
  earlier_ = earlier_of(given);
  for (const auto& [name, parameter] : given.parameters)
    list_.push_back(Builder(name, parameter, announced, earlier_, file).take());
  check_overlap(list_, file);
  const bool begins_there = std::any_of(list_.begin(), list_.end(), [](const auto& one) { return one.mother; });
  if (!given.prior_from.empty() && !begins_there)
    throw input_error("{}: has none of these parameters; it has {}", file.where("identification.prior_from"),
                      fmt::join(earlier_.names(), ", "));
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

MatrixXd IdentifiedParameters::prior_covariance() const {
  MatrixXd covariance = prior_variances().asDiagonal();
  for (std::size_t i = 0; i < list_.size(); ++i)
    for (std::size_t j = 0; j < list_.size(); ++j)
      if (i != j && list_[i].mother && list_[j].mother)
        covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            earlier_.covariance(*list_[i].mother, *list_[j].mother);  // (K.9)
  return covariance;
}

VectorXd IdentifiedParameters::walked(double dt) const {
  VectorXd variances(list_.size());
  for (Eigen::Index i = 0; i < variances.size(); ++i)
    variances(i) = std::pow(list_[static_cast<std::size_t>(i)].walk, 2) * dt;
  return variances;
}

NamedValues IdentifiedParameters::values_at(const VectorXd& theta) const {
  NamedValues all;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const double value = list_[i].value(theta(static_cast<Eigen::Index>(i)));
    for (const auto& target : list_[i].targets) {
      all.names.push_back(target.name);
      all.values.push_back(value * target.scale);
    }
  }
  return all;
}

NamedValues IdentifiedParameters::values(const VectorXd& theta) const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    moved_ += list_[i].is_moved(theta(static_cast<Eigen::Index>(i))) ? 1 : 0;
  return values_at(theta);
}

}  // namespace tether
