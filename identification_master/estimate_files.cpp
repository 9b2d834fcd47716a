#include "identification_master/estimate_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/base/parameter_table.hpp"
#include "common/base/transform.hpp"
#include "identification_master/identifiability.hpp"
#include "identification_master/sensitivity_tables.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

constexpr double two_sided_95 = 1.959963984540054;

void write_whole(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path part = path.string() + ".part";
  std::ofstream file(part, std::ios::binary);
  file << text << std::flush;
  if (!file) throw run_error("{}: cannot be written", part.string());
  file.close();
  std::filesystem::rename(part, path);
}

std::string headings(const IdentifiedParameters& parameters) {
  const auto& list = parameters.list();
  std::vector<std::string> names;
  for (const IdentifiedParameter& p : list) names.push_back(p.name);
  const std::vector<std::string> columns = columns_of(names);
  std::string line = "time [s]";
  for (std::size_t i = 0; i < columns.size(); ++i)
    line += ", " + columns[i] + (i < 3 * list.size() ? fmt::format(" [{}]", list[i / 3].unit) : "");
  return line + ", data, chi_square, expected_chi_square, rejected, tempering, evaluations\n";
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
  return line + fmt::format(", {}, {}, {}, {}, {}, {}\n", record.data, record.chi_square, record.expected_chi_square,
                            record.rejected_share(), record.tempering, record.evaluations);
}

Json range_of(const IdentifiedParameter& parameter, double mean, double deviation) {
  const ValueEstimate value = estimate_of(parameter, mean, deviation);
  return {{"value", value.median},
          {"lower_95", value.lower},
          {"upper_95", value.upper},
          {"theta", mean},
          {"theta_deviation", deviation}};
}

Json list_of(const auto& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json rows_of(const MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(list_of(VectorXd(matrix.row(i))));
  return rows;
}

/// The bound that holds the estimate back: "lower", "upper", or null.
Json bound_at(const IdentifiedParameter& parameter, double mean) {
  if (!parameter.is_moved(mean)) return {};
  return parameter.value(mean) < parameter.value(parameter.prior_mean) ? "lower" : "upper";
}

Json parameters_json(const IdentifiedParameters& parameters, const Identification& done, const Identifiability& what) {
  Json all = Json::array();
  const EstimateRecord& last = done.last();
  for (std::size_t i = 0; i < parameters.list().size(); ++i) {
    const IdentifiedParameter& p = parameters.list()[i];
    const auto k = static_cast<Eigen::Index>(i);
    Json targets = Json::array();
    for (const auto& target : p.targets)
      targets.push_back({{"name", target.name}, {"value", target.scale * p.value(last.mean(k))}});
    all.push_back({{"name", p.name},
                   {"sets", targets},
                   {"unit", p.unit},
                   {"transform", name_of(p.transform)},
                   {"prior", range_of(p, p.prior_mean, p.prior_deviation)},
                   {"estimate", range_of(p, last.mean(k), std::sqrt(last.covariance(k, k)))},
                   {"at_bound", bound_at(p, last.mean(k))},
                   {"retained_information", what.retained(k)}});
  }
  return all;
}

Json innovations_json(const Identification& done) {
  const DataTotals all = totals_of(done.state().records);
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  return {{"effective_data", all.data},
          {"used_data", all.used},
          {"chi_square", all.chi_square},
          {"expected_chi_square", all.expected_chi_square},
          {"chi_square_per_datum", share(all.chi_square, all.expected_chi_square)},
          {"autocorrelation_between_frames", done.state().innovations.autocorrelation()},
          {"rejected_share", share(all.rejected, all.data + all.rejected)},
          {"tempered_steps", all.tempered_steps}};
}

}  // namespace

void remove_old_estimates(const std::filesystem::path& output) {
  for (const char* name : {"estimate.json", "estimate.csv", "identified.yaml", "plots/estimate.png",
                           SensitivityTables::by_region, SensitivityTables::by_datum, "checkpoint/identification.bin"})
    std::filesystem::remove(output / name);
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

void write_estimates(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                     const std::vector<EstimateRecord>& records) {
  std::string text = headings(parameters);
  for (const EstimateRecord& record : records) text += row(parameters, record);
  write_whole(path, text);
}

void write_estimate(const std::filesystem::path& path, const IdentifiedParameters& parameters,
                    const Identification& done, const IdentificationFacts& facts) {
  const EstimateRecord& last = done.last();
  const MatrixXd prior = parameters.prior_variances().asDiagonal();
  const Identifiability what = identifiability(prior, last.covariance);
  const Json json{{"case", facts.case_name},
                  {"title", facts.title},
                  {"case_file", facts.case_file},
                  {"time", last.time},
                  {"steps", done.state().step},
                  {"corrected", done.plan().corrects},
                  {"parameters", parameters_json(parameters, done, what)},
                  {"correlations", rows_of(correlations(last.covariance))},
                  {"covariance_of_theta", rows_of(last.covariance)},
                  {"identifiability",
                   {{"gramian", rows_of(what.gramian)},
                    {"information", list_of(what.information)},
                    {"directions", rows_of(what.directions.transpose())}}},
                  {"innovations", innovations_json(done)},
                  {"values_moved_into_their_range", facts.cost.moved_values},
                  {"notices", facts.notices},
                  {"cost",
                   {{"particles", last.mean.size() + 1},
                    {"groups", facts.groups},
                    {"wall_seconds", facts.cost.wall_seconds},
                    {"cpu_seconds", facts.cost.cpu_seconds},
                    {"master_loop_cpu_seconds", facts.cost.master_cpu_seconds},
                    {"peak_memory_mb", facts.peak_memory_mb}}}};
  write_whole(path, json.dump(2) + "\n");
}

}  // namespace tether
