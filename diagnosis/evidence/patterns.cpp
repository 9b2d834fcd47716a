#include "diagnosis/evidence/patterns.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "diagnosis/evidence/data_errors.hpp"

namespace tether {

void add_patterns(EffectProblem& problem, const Evidence& evidence, const AllowanceCase& allowed, double start,
                  double end) {
  const auto n = problem.residual.size();
  struct Column {
    VectorXd values;
    double deviation;
  };
  std::map<std::tuple<int, double, int>, Column> columns;  // a NaN has no order: start - 1, - 2, - 3 stand for the beat
  for (const auto& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    const double phase = 2 * std::numbers::pi * (part.time - start) / (end - start);
    const double model = allowed.of_model(evidence.noise(part).deviation);
    const auto add = [&](double key, double value, int form) {
      for (Index i = part.first; i < part.first + part.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double shape = std::cos(form * std::numbers::pi * evidence.along()[k]);
        columns.try_emplace({evidence.regions()[k], key, form}, Column{VectorXd::Zero(n), model})
            .first->second.values(i) = value * shape;
      }
    };
    for (int form = 0; form < 3; ++form) add(part.time, 1, form);
    add(start - 1, 1, 0);
    add(start - 2, std::cos(phase), 0);
    add(start - 3, std::sin(phase), 0);
  }
  for (const auto& [place, column] : columns) {
    const auto& [number, time, form] = place;
    append_columns(problem.patterns, column.values);
    const std::string region = number >= 0 ? evidence.region_names()[static_cast<std::size_t>(number)] : "wall";
    problem.pattern_names.push_back({region, time < start - 0.5 ? undefined : time, static_cast<Pattern::Form>(form)});
    problem.pattern_deviation.conservativeResize(problem.patterns.cols());
    problem.pattern_deviation.tail(1).setConstant(column.deviation);
    const auto before = problem.allowed.cols();
    allow(problem, column.values, column.deviation, "");
    if (problem.allowed.cols() > before) problem.allowed_patterns.push_back(before);
  }
}

}  // namespace tether
