#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/units.hpp"

namespace tether {

/// A comma-separated table whose first line names the columns: "time, flow [ml/s]". Lines that are empty or begin with
/// # are skipped. Cells stay text until a column is asked for.
class CsvTable {
 public:
  /// Throws InputError for a file that cannot be read, has no rows, or a row with another number of cells than there
  /// are columns.
  explicit CsvTable(const std::filesystem::path& file);

  const std::vector<std::string>& columns() const { return columns_; }
  /// In brackets after each column's name; empty if there is none.
  const std::vector<std::string>& units() const { return units_; }
  std::size_t rows() const { return lines_.size(); }
  bool has(std::string_view column) const;
  std::string unit(std::string_view column) const;
  /// Throws InputError "file:line: ..." for a missing column or a cell that is not a finite number.
  std::vector<double> numbers(std::string_view column) const;
  /// In the case's units. `unit`: of the column; empty: that of its heading, or the case's. Throws InputError also for
  /// a unit that is unknown or of another dimension.
  std::vector<double> quantities(std::string_view column, const UnitSystem& units, Dimension dimension,
                                 const std::string& unit = {}) const;
  std::vector<std::string> texts(std::string_view column) const;
  /// Throws InputError "file:line: ..." for one that is neither empty nor a name.
  std::vector<std::string> names(std::string_view column) const;
  /// "file:line" of a row, for messages about its values.
  std::string where(std::size_t row) const;

 private:
  std::size_t index(std::string_view column) const;

  std::string file_;
  std::vector<std::string> columns_, units_;
  std::vector<int> lines_;                       ///< line in the file, per row
  std::vector<std::vector<std::string>> cells_;  ///< per row
};

}  // namespace tether
