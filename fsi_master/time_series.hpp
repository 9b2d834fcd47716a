#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/io/growing_table.hpp"

namespace tether {

/// A number of every step: "fluid.outlet.flow" in "cm3/s".
struct Column {
  std::string name, unit;
};

/// timeseries.csv: one row a step, headings "fluid.outlet.flow [cm3/s]". Numbers are in the case's units and read back
/// exactly; behind them stand pressures, lengths and flows once more in mmHg, mm and ml/s, where that is another
/// number.
class TimeSeries {
 public:
  TimeSeries(std::filesystem::path path, std::vector<Column> columns, const UnitSystem& units);

  void start() { table_.start(); }
  void resume(std::int64_t rows, std::uint64_t checksum) { table_.resume(rows, checksum); }
  /// To be read by others when this returns. Throws RunError if it cannot be written.
  void append(const std::vector<double>& values);
  void flush() const { table_.flush(); }
  std::uint64_t checksum() const { return table_.checksum(); }

 private:
  struct Copy {
    std::size_t source;
    Column column;
    double factor;
  };
  std::string headings() const;
  static std::vector<Copy> copies_of(const std::vector<Column>& columns, const UnitSystem& units);

  std::vector<Column> columns_;
  std::vector<Copy> copies_;
  GrowingTable table_;
};

}  // namespace tether
