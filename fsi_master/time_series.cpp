#include "fsi_master/time_series.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"

namespace tether {

TimeSeries::TimeSeries(std::filesystem::path path, std::vector<Column> columns, const UnitSystem& units)
    : path_(std::move(path)), columns_(std::move(columns)) {
  struct Clinical {
    Dimension dimension;
    const char* unit;
    double factor;
  };
  const Clinical clinical[] = {{dimension::pressure, "mmHg", units.to_mmhg(1)},
                               {dimension::length, "mm", units.to_mm(1)},
                               {dimension::flow, "ml/s", units.to_ml_per_s(1)}};
  for (std::size_t i = 0; i < columns_.size(); ++i)
    for (const Clinical& c : clinical)
      if (columns_[i].unit == units.symbol(c.dimension) && std::abs(c.factor - 1) > 1e-12)
        copies_.push_back({i, {columns_[i].name, c.unit}, c.factor});
}

std::string TimeSeries::headings() const {
  std::string line;
  const auto add = [&line](const Column& column) {
    line += fmt::format("{}{}{}", line.empty() ? "" : ",", column.name,
                        column.unit.empty() || column.unit == "1" ? "" : fmt::format(" [{}]", column.unit));
  };
  for (const Column& column : columns_) add(column);
  for (const Copy& copy : copies_) add(copy.column);
  return line;
}

void TimeSeries::open(std::ios::openmode mode) {
  file_ = std::ofstream(path_, mode);
  if (!file_) throw write_error(path_);
}

void TimeSeries::start() {
  open(std::ios::trunc);
  checksum_ = 0;
  write(headings());
}

void TimeSeries::write(const std::string& line) {
  checksum_ = hash_values(line, checksum_);
  file_ << line << std::endl;
  if (!file_) throw write_error(path_);
}

void TimeSeries::resume(std::int64_t rows, std::uint64_t checksum) {
  std::ifstream old(path_);
  std::string line, kept;
  if (!std::getline(old, line) || line != headings())
    throw input_error("{}: is not the table that the checkpoint belongs to (other headings, or no file)",
                      path_.string());
  kept = line + "\n";
  std::uint64_t found = hash_values(line, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    if (!std::getline(old, line)) throw input_error("{}: has {} rows, the checkpoint {}", path_.string(), row, rows);
    kept += line + "\n";
    found = hash_values(line, found);
  }
  if (found != checksum)
    throw input_error("{}: was changed: its first {} rows are not those that the run wrote", path_.string(), rows);
  checksum_ = checksum;
  write_whole(path_, kept);
  open(std::ios::app);
}

void TimeSeries::append(const std::vector<double>& values) {
  TETHER_ASSERT(values.size() == columns_.size(), "{} values for {} columns", values.size(), columns_.size());
  std::string line = fmt::format("{}", values.front());
  for (std::size_t i = 1; i < values.size(); ++i) line += fmt::format(",{}", values[i]);
  for (const Copy& copy : copies_) line += fmt::format(",{}", copy.factor * values[copy.source]);
  write(line);
}

}  // namespace tether
