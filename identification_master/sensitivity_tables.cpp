#include "identification_master/sensitivity_tables.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text, std::ios::openmode mode) {
  std::ofstream file(path, std::ios::binary | mode);
  file << text << std::flush;
  if (!file) throw write_error(path);
}

/// A table without the rows of later times.
void cut(const fs::path& path, double time) {
  std::ifstream file(path);
  std::string kept, line;
  const auto is_kept = [&] {
    return kept.empty() || std::strtod(line.c_str(), nullptr) <= time + 1e-9 * std::abs(time);
  };
  while (std::getline(file, line) && is_kept()) kept += line + "\n";
  if (kept.empty()) throw input_error("{}: is missing; start anew without --resume", path.string());
  write(path, kept, std::ios::trunc);
}

}  // namespace

SensitivityTables::SensitivityTables(const fs::path& output, const Observations& data, const LumenSurface& lumen,
                                     const std::vector<std::string>& parameters, VectorXd deviations,
                                     const UnitSystem& units)
    : output_(output), parameters_(parameters), deviations_(std::move(deviations)) {
  for (const Measurement* source : data.all()) add_source(*source, lumen, units.symbol(source->facts().dimension));
  TETHER_ASSERT(std::ssize(positions_) == deviations_.size(), "{} data with {} deviations", positions_.size(),
                deviations_.size());
}

void SensitivityTables::add_source(const Measurement& source, const LumenSurface& lumen, const std::string& unit) {
  const CountedRows rows = source.rows(lumen.points, 0);
  const bool on_lumen = source.facts().kind.on_lumen;
  const std::size_t first = groups_.size(), regions = on_lumen ? lumen.region_names.size() + 1 : 1;
  for (const std::string& name : rows.groups)
    for (std::size_t region = 0; region < regions; ++region)
      groups_.push_back({name, region == 0 ? "" : lumen.region_names[region - 1], unit, {}});
  for (std::size_t row = 0; row < rows.group_of.size(); ++row) {
    const std::size_t group = rows.group_of[row] * regions + static_cast<std::size_t>(rows.region[row] + 1);
    groups_[first + group].data.push_back(static_cast<Eigen::Index>(positions_.size()));
    positions_.emplace_back();
    if (rows.positions.cols() > 0) positions_.back() = rows.positions.col(static_cast<Eigen::Index>(row));
  }
}

void SensitivityTables::begin() {
  std::string heads = "time [s], observation, region, unit, data";
  for (const std::string& name : parameters_) heads += fmt::format(", {0}, {0}.mean, {0}.information", name);
  write(output_ / by_region, heads + "\n", std::ios::trunc);
  heads = "time [s], observation, region, unit, data, x, y, z";
  for (const std::string& name : parameters_) heads += ", " + name;
  write(output_ / by_datum, heads + "\n", std::ios::trunc);
}

void SensitivityTables::continue_from(double time) {
  for (const char* name : {by_region, by_datum}) cut(output_ / name, time);
}

void SensitivityTables::add(const StepSensitivities& step) {
  std::string regions, data;
  for (const Group& group : groups_) {
    regions += row_of(group, step);
    data += rows_of_data(group, step);
  }
  write(output_ / by_region, regions, std::ios::app);
  write(output_ / by_datum, data, std::ios::app);
}

/// Empty if none of them is observed.
std::string SensitivityTables::row_of(const Group& group, const StepSensitivities& step) const {
  const VectorXd W = step.precision(group.data);
  if (!(W.sum() > 0)) return {};
  const MatrixXd S = step.changes(group.data, Eigen::all);
  const double number = W.dot(deviations_(group.data).cwiseAbs2());
  std::string row =
      fmt::format("{}, {}, {}, {}, {:.6g}", step.time, group.observation, group.region, group.unit, number);
  for (const auto s : S.colwise()) {
    const double information = W.dot(s.cwiseAbs2());
    row += fmt::format(", {:.6g}, {:.6g}, {:.6g}", std::sqrt(information / W.sum()), W.dot(s) / W.sum(), information);
  }
  return row + "\n";
}

std::string SensitivityTables::rows_of_data(const Group& group, const StepSensitivities& step) const {
  std::string rows;
  for (const Eigen::Index i : group.data) {
    if (step.precision(i) == 0 || !step.on_frame[static_cast<std::size_t>(i)]) continue;
    const double number = step.precision(i) * deviations_(i) * deviations_(i);
    rows += fmt::format("{}, {}, {}, {}, {:.6g}", step.time, group.observation, group.region, group.unit, number);
    const std::optional<Vec3>& place = positions_[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis) rows += place ? fmt::format(", {:.6g}", (*place)(axis)) : ", ";
    for (const double s : step.changes.row(i)) rows += fmt::format(", {:.6g}", s);
    rows += "\n";
  }
  return rows;
}

}  // namespace tether
