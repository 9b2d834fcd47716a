#include "fsi_master/time_series.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"

namespace tether {

TimeSeries::TimeSeries(std::filesystem::path path, std::vector<Column> columns, const UnitSystem& units)
    : columns_(std::move(columns)), copies_(copies_of(columns_, units)), table_(std::move(path), headings()) {}

std::vector<TimeSeries::Copy> TimeSeries::copies_of(const std::vector<Column>& columns, const UnitSystem& units) {
  struct Clinical {
    Dimension dimension;
    const char* unit;
    double factor;
  };
  const Clinical clinical[] = {{dimension::pressure, "mmHg", units.to_mmhg(1)},
                               {dimension::length, "mm", units.to_mm(1)},
                               {dimension::flow, "ml/s", units.to_ml_per_s(1)}};
  std::vector<Copy> copies;
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const Clinical& c : clinical)
      if (columns[i].unit == units.symbol(c.dimension) && std::abs(c.factor - 1) > 1e-12)
        copies.push_back({i, {columns[i].name, c.unit}, c.factor});
  return copies;
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

void TimeSeries::append(const std::vector<double>& values) {
  TETHER_ASSERT(values.size() == columns_.size(), "{} values for {} columns", values.size(), columns_.size());
  std::string line = fmt::format("{}", values.front());
  for (std::size_t i = 1; i < values.size(); ++i) line += fmt::format(",{}", values[i]);
  for (const Copy& copy : copies_) line += fmt::format(",{}", copy.factor * values[copy.source]);
  table_.append(line);
}

}  // namespace tether
