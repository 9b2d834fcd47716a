#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/units.hpp"

namespace tether {

/// Who made a table. A person's is not trusted. Tether's own (timeseries.csv, estimate.csv) may hold numbers of any
/// size, and copies of a column in other units behind it: the first is read.
enum class TableOf { person, tether };

/// A comma-separated table whose first line names the columns: "time, flow [ml/s]". Lines that are empty or begin with
/// # are skipped. Cells stay where they are in the file's text until a column is asked for.
class CsvTable {
 public:
  /// Throws InputError for a file that cannot be read, has no rows, a row with another number of cells than there are
  /// columns, a quotation mark alone, two columns of one name and unit, or one larger than any table is: a line of more
  /// than 1 MB, more than 10,000 columns or 20 million cells.
  explicit CsvTable(const std::filesystem::path& file, TableOf by = TableOf::person);

  const std::vector<std::string>& columns() const { return columns_; }
  /// In brackets after each column's name; empty if there is none.
  const std::vector<std::string>& units() const { return units_; }
  /// The columns' names as messages list them.
  std::string listed_columns() const;
  std::size_t rows() const { return lines_.size(); }
  bool has(std::string_view column) const;
  std::string unit(std::string_view column) const;
  /// Throws InputError "file:line: ..." for a missing column, one that is there twice, or a cell that is not a finite
  /// number, or larger than largest_given.
  std::vector<double> numbers(std::string_view column) const;
  /// In the case's units. `unit`: of the column; empty: that of its heading, or the case's. Throws InputError also for
  /// a unit that is unknown, of another dimension, or another than that of the heading. A column may be there again in
  /// another unit, with the same values.
  std::vector<double> quantities(std::string_view column, const UnitSystem& units, Dimension dimension,
                                 const std::string& unit = {}) const;
  std::vector<std::string> texts(std::string_view column) const;
  /// Throws InputError "file:line: ..." for one that is neither empty nor a name.
  std::vector<std::string> names(std::string_view column) const;
  /// "file:line" of a row, for messages about its values.
  std::string where(std::size_t row) const;

 private:
  /// A line of the file, from one place of its text to another.
  void take_line(std::size_t begin, std::size_t end, int line);
  /// Notes where its cells begin, and returns how many there are.
  std::size_t split(std::size_t begin, std::size_t end, int line);
  void take_headings(int line);
  void take_row(std::size_t cells, int line);
  /// Without blanks and quotes around it.
  std::string_view cell(std::size_t row, std::size_t column) const;
  std::size_t index(std::string_view column) const;
  /// Others of the same name behind it.
  std::vector<std::size_t> copies(std::size_t column) const;
  /// The same of a column that is there once.
  std::size_t single(std::string_view column) const;
  std::vector<double> numbers_at(std::size_t column) const;
  /// Throws InputError if the unit and the heading's contradict each other: one of them would be a slip.
  void check_stated(std::size_t column, const UnitSystem& units, Dimension dimension, const std::string& unit) const;
  std::vector<double> quantities_at(std::size_t column, const UnitSystem& units, Dimension dimension,
                                    const std::string& unit) const;

  std::string file_;
  TableOf by_;
  std::vector<std::string> columns_, units_;
  std::vector<int> lines_;             ///< line in the file, per row
  std::string text_;                   ///< the file's
  std::vector<std::uint32_t> begins_;  ///< of the cells in it, row by row; behind each row's where one more would begin
};

}  // namespace tether
