#include "identification_master/estimate_files.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/parameter_table.hpp"
#include "common/base/transform.hpp"
#include "common/base/whole_file.hpp"
#include "common/config/files_to_go_on_with.hpp"
#include "common/io/record_file.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/identifiability.hpp"
#include "identification_master/results/estimate.hpp"
#include "identification_master/sensitivity_tables.hpp"

namespace tether {
namespace {

constexpr double two_sided_95 = 1.959963984540054;

std::string headings(const IdentifiedParameters& parameters) {
  const auto& list = parameters.list();
  std::vector<std::string> names;
  for (const IdentifiedParameter& p : list) names.push_back(p.name);
  const std::vector<std::string> columns = columns_of(names);
  std::string line = "time [s]";
  for (std::size_t i = 0; i < columns.size(); ++i)
    line += ", " + columns[i] + (i < 3 * list.size() ? fmt::format(" [{}]", list[i / 3].unit) : "");
  return line + ", data, chi_square, expected_chi_square, rejected, tempering, evaluations";
}

std::string row(const IdentifiedParameters& parameters, const EstimateRecord& record) {
  std::string line = fmt::format("{}", record.time);
  const auto& list = parameters.list();
  const VectorXd deviations = record.covariance.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const ValueEstimate value = estimate_of(list[i], record.mean(k), deviations(k));
    line += fmt::format(", {}, {}, {}", value.median, value.lower, value.upper);
  }
  for (Eigen::Index k = 0; k < deviations.size(); ++k) line += fmt::format(", {}, {}", record.mean(k), deviations(k));
  const MatrixXd correlation = correlations(record.covariance);
  for (Eigen::Index i = 0; i < correlation.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) line += fmt::format(", {}", correlation(j, i));
  return line + fmt::format(", {}, {}, {}, {}, {}, {}", record.data, record.chi_square, record.expected_chi_square,
                            record.rejected_share(), record.tempering, record.evaluations);
}

EstimateRange range_of(const IdentifiedParameter& parameter, double mean, double deviation) {
  const ValueEstimate value = estimate_of(parameter, mean, deviation);
  return {value.median, value.lower, value.upper, mean, deviation};
}

/// The bound that holds the estimate back.
std::optional<Bound> bound_at(const IdentifiedParameter& parameter, double mean) {
  if (!parameter.is_moved(mean)) return std::nullopt;
  return parameter.value(mean) < parameter.value(parameter.prior_mean) ? Bound::lower : Bound::upper;
}

EstimatedParameter estimated(const IdentifiedParameter& p, double mean, double deviation, double retained) {
  EstimatedParameter told{p.name,
                          {},
                          p.unit,
                          name_of(p.transform),
                          range_of(p, p.prior_mean, p.prior_deviation),
                          range_of(p, mean, deviation),
                          bound_at(p, mean),
                          retained};
  for (const auto& target : p.targets) told.sets.push_back({target.name, target.scale * p.value(mean)});
  return told;
}

InnovationsTold innovations_of(const Identification& done) {
  const DataTotals& all = done.state().totals;
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  return {all.data,
          all.used,
          all.chi_square,
          all.expected_chi_square,
          share(all.chi_square, all.expected_chi_square),
          done.state().innovations.autocorrelation(),
          share(all.rejected, all.data + all.rejected),
          all.tempered_steps};
}

std::vector<LastingErrorTold> lasting_errors_of(const Identification& done) {
  const LastingErrors& found = done.state().lasting;
  std::vector<LastingErrorTold> all;
  if (!done.plan().corrects) return all;
  const VectorXd deviations = found.whole_covariance().diagonal().cwiseSqrt();
  for (const LastingError& error : done.lasting_errors()) {
    const auto k = static_cast<Eigen::Index>(all.size());
    all.push_back(
        {error.source, error.name, error.deviation, error.deviation * found.mean(k), error.deviation * deviations(k)});
  }
  return all;
}

EstimateCost cost_of(const IdentificationFacts& facts, Eigen::Index parameters) {
  return {static_cast<int>(parameters) + 1, static_cast<int>(facts.groups), facts.cost.wall_seconds,
          facts.cost.cpu_seconds,           facts.cost.master_cpu_seconds,  facts.peak_memory_mb};
}

}  // namespace

void remove_old_estimates(const std::filesystem::path& output) {
  check_not_changed_meanwhile(output, {identified_file});
  for (const char* name : {"estimate.json", "estimate.csv", identified_file, "plots/estimate.png",
                           SensitivityTables::by_region, SensitivityTables::by_datum})
    std::filesystem::remove(output / name);
  remove_identification_checkpoints(output);
}

ValueEstimate estimate_of(const IdentifiedParameter& parameter, double mean, double deviation) {
  const auto bounded = [&](double theta) {
    const Range& range = parameter.range;
    return std::clamp(unstretched(parameter.transform, theta, range), range.lower, range.upper);
  };
  const double value = parameter.value(mean);
  return {value, std::min(value, bounded(mean - two_sided_95 * deviation)),
          std::max(value, bounded(mean + two_sided_95 * deviation))};
}

EstimateTable::EstimateTable(const std::filesystem::path& output, const IdentifiedParameters& parameters)
    : parameters_(parameters), table_(output / "estimate.csv", headings(parameters)) {}

void EstimateTable::start(const EstimateRecord& prior) {
  table_.start();
  append(prior);
}

void EstimateTable::append(const EstimateRecord& record) {
  table_.append(row(parameters_, record));
}

void write_estimate(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                    const Identification& done, const IdentificationFacts& facts) {
  const EstimateRecord& last = done.last();
  const Identifiability what = identifiability(parameters.prior_covariance(), last.covariance);
  Estimate estimate;
  estimate.case_name = facts.case_name;
  estimate.title = facts.title;
  estimate.case_file = facts.case_file;
  estimate.time = last.time;
  estimate.steps = done.state().step;
  estimate.corrected = done.plan().corrects;
  for (std::size_t i = 0; i < parameters.list().size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    estimate.parameters.push_back(
        estimated(parameters.list()[i], last.mean(k), std::sqrt(last.covariance(k, k)), what.retained(k)));
  }
  estimate.correlations = correlations(last.covariance);
  estimate.covariance_of_theta = last.covariance;
  estimate.lasting_errors = lasting_errors_of(done);
  estimate.identifiability = {
      what.gramian, {what.information.begin(), what.information.end()}, what.directions.transpose()};
  estimate.innovations = innovations_of(done);
  estimate.values_moved_into_their_range = facts.cost.moved_values;
  estimate.notices = facts.notices;
  estimate.cost = cost_of(facts, last.mean.size());
  write_whole(path, json_of(estimate) + "\n");
}

}  // namespace tether
