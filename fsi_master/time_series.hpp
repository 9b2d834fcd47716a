#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/base/checked_file.hpp"
#include "common/base/units.hpp"

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

  /// A new file with its headings.
  void start();
  /// Goes on behind the first `rows` rows of the file; later ones are dropped. Throws InputError if the file has other
  /// headings, fewer rows or others than those of the checksum; it is as it was then.
  void resume(std::int64_t rows, std::uint64_t checksum);
  /// To be read by others when this returns. Throws RunError if it cannot be written.
  void append(const std::vector<double>& values);
  /// To the disk: what a checkpoint counts on must outlast a loss of power. Throws RunError.
  void flush() const { flush_to_disk(path_); }
  /// Of the headings and all rows so far.
  std::uint64_t checksum() const { return checksum_; }

 private:
  struct Copy {
    std::size_t source;
    Column column;
    double factor;
  };
  std::string headings() const;
  void open(std::ios::openmode mode);
  void write(const std::string& line);

  std::filesystem::path path_;
  std::vector<Column> columns_;
  std::vector<Copy> copies_;
  std::uint64_t checksum_ = 0;
  std::ofstream file_;
};

}  // namespace tether
