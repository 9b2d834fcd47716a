#include "fsi_master/periodicity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/csv.hpp"
#include "common/config/case_tree.hpp"

namespace tether {
namespace {

/// A quantity at a time that is not before the first step's end, linear between the ends of steps.
double value_at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.end()) return values.back();
  const auto i = std::max<std::size_t>(1, static_cast<std::size_t>(after - times.begin()));
  const double s = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - s) * values[i - 1] + s * values[i];
}

struct StepsOfBeat {
  std::size_t begin = 0, end = 0;
};

/// The steps that end in a beat; its first moment is the last one of the beat before.
StepsOfBeat steps_of(const BeatingRun& run, double period, std::int64_t beat) {
  const double from = run.start + static_cast<double>(beat - 1) * period, slack = 1e-6 * period;
  const auto index = [&](double time) {
    return static_cast<std::size_t>(std::upper_bound(run.times.begin(), run.times.end(), time + slack) -
                                    run.times.begin());
  };
  return {index(from), index(from + period)};
}

/// Largest change against the beat before over the mean of this one; not finite if that is not positive.
double change_of(const BeatingRun& run, const std::vector<double>& values, double period, const StepsOfBeat& steps) {
  double largest = 0, sum = 0;
  for (std::size_t i = steps.begin; i < steps.end; ++i) {
    sum += values[i];
    const double before = run.times[i] - period;
    if (before < run.times.front() - 1e-6 * period) continue;  // nothing is known within the first step
    largest = std::max(largest, std::abs(values[i] - value_at(run.times, values, before)));
  }
  return sum > 0 ? largest * static_cast<double>(steps.end - steps.begin) / sum
                 : std::numeric_limits<double>::infinity();
}

const YamlNode* inlets_of(const YamlNode& tree) {
  const YamlNode* fluid = tree.find("fluid");
  return fluid ? fluid->find("inlets") : nullptr;
}

std::optional<double> period_of(const YamlNode* inlets, const UnitSystem& units) {
  std::optional<double> common;
  if (!inlets) return common;
  for (const auto& inlet : inlets->entries)
    for (const auto& field : inlet.value.entries) {
      if (field.value.kind != YamlNode::Kind::map || !field.value.find("file")) continue;
      const YamlNode* period = field.value.find("period");
      if (!period || period->kind != YamlNode::Kind::scalar) return std::nullopt;
      const double value = units.quantity(period->text, dimension::time);
      if (common && std::abs(value - *common) > 1e-9 * *common) return std::nullopt;
      common = value;
    }
  return common;
}

}  // namespace

std::optional<Periodicity> periodicity_of(const BeatingRun& run, double period) {
  Periodicity found;
  found.period = period;
  found.limit = periodic_limit;
  if (run.times.empty()) return std::nullopt;
  const auto beats = static_cast<std::int64_t>(std::floor((run.times.back() - run.start) / period + 1e-6));
  for (std::int64_t beat = 2; beat <= beats; ++beat) {
    const StepsOfBeat steps = steps_of(run, period, beat);
    BeatChange change{beat, 0, change_of(run, run.volumes, period, steps)};
    for (const auto& pressures : run.pressures)
      change.pressure = std::max(change.pressure, change_of(run, pressures, period, steps));
    if (!std::isfinite(change.pressure) || !std::isfinite(change.volume)) return std::nullopt;
    found.beats.push_back(change);
    if (!found.periodic_from && std::max(change.pressure, change.volume) <= periodic_limit) found.periodic_from = beat;
  }
  return found.beats.empty() ? std::nullopt : std::optional(found);
}

std::optional<double> period_of_inlets(const std::filesystem::path& case_file, const UnitSystem& units) {
  const YamlNode tree = read_case_tree(case_file);
  return period_of(inlets_of(tree), units);
}

std::optional<Periodicity> periodicity_of(const std::filesystem::path& table, const std::filesystem::path& case_file,
                                          double start, double image_pressure, const UnitSystem& units) {
  const YamlNode tree = read_case_tree(case_file);
  const YamlNode* inlets = inlets_of(tree);
  const std::optional<double> period = period_of(inlets, units);
  if (!period) return std::nullopt;
  const CsvTable rows(table, TableOf::tether);
  if (!rows.has("time") || !rows.has("fluid.volume")) return std::nullopt;
  BeatingRun run{start, rows.numbers("time"), {}, rows.numbers("fluid.volume")};
  for (const auto& inlet : inlets->entries) {
    const std::string column = "fluid." + inlet.key + ".pressure";
    if (!rows.has(column)) return std::nullopt;
    for (double& value : run.pressures.emplace_back(rows.numbers(column))) value += image_pressure;
  }
  return periodicity_of(run, *period);
}

}  // namespace tether
