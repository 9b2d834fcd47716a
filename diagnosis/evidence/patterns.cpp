#include "diagnosis/evidence/patterns.hpp"

#include <cmath>
#include <compare>
#include <map>
#include <numbers>
#include <optional>

#include "diagnosis/evidence/data_errors.hpp"

namespace tether {
namespace {

enum class Wave { sine, cosine, constant };

/// What a pattern is of: a region at one moment, or over the beat as a wave of one period.
struct PatternKey {
  int region;
  std::optional<double> moment;  ///< [time]; none: the beat
  Wave wave;
  int form;  ///< half waves along the region
  auto operator<=>(const PatternKey&) const = default;
};

}  // namespace

void add_patterns(EffectProblem& problem, const Evidence& evidence, const AllowanceCase& allowed, double start,
                  double end) {
  const auto n = problem.residual.size();
  struct Column {
    VectorXd values;
    double deviation;
  };
  std::map<PatternKey, Column> columns;
  for (const auto& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    const double phase = 2 * std::numbers::pi * (part.time - start) / (end - start);
    const double model = allowed.of_model(evidence.noise(part).deviation);
    const auto add = [&](std::optional<double> moment, Wave wave, double value, int form) {
      for (Index i = part.first; i < part.first + part.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double shape = std::cos(form * std::numbers::pi * evidence.along()[k]);
        columns.try_emplace({evidence.regions()[k], moment, wave, form}, Column{VectorXd::Zero(n), model})
            .first->second.values(i) = value * shape;
      }
    };
    for (int form = 0; form < 3; ++form) add(part.time, Wave::constant, 1, form);
    add({}, Wave::constant, 1, 0);
    add({}, Wave::cosine, std::cos(phase), 0);
    add({}, Wave::sine, std::sin(phase), 0);
  }
  for (const auto& [key, column] : columns) {
    append_columns(problem.patterns, column.values);
    const std::string region = key.region >= 0 ? evidence.region_names()[static_cast<std::size_t>(key.region)] : "wall";
    problem.pattern_names.push_back({region, key.moment.value_or(undefined), static_cast<Pattern::Form>(key.form)});
    problem.pattern_deviation.conservativeResize(problem.patterns.cols());
    problem.pattern_deviation.tail(1).setConstant(column.deviation);
    const auto before = problem.allowed.cols();
    allow(problem, column.values, column.deviation);
    if (problem.allowed.cols() > before) problem.allowed_patterns.push_back(before);
  }
}

}  // namespace tether
