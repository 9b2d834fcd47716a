#include "common/base/csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>

#include "common/base/error.hpp"
#include "common/base/given_number.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"

namespace tether {
namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

/// Without any, or with one at each end.
bool has_right_quotes(std::string_view cell) {
  const auto first = cell.find('"');
  if (first == std::string_view::npos) return true;
  const auto second = cell.find('"', first + 1);
  constexpr std::string_view blank = " \t\r";
  return first == cell.find_first_not_of(blank) && second == cell.find_last_not_of(blank);
}

/// Throws InputError "where: ..." for a cell whose quotation marks are not around it.
std::vector<std::string> split(const std::string& line, const std::string& where) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view cell = std::string_view(line).substr(begin, end - begin);
    if (!has_right_quotes(cell))
      throw input_error(
          "{}: cell {} has a quotation mark that does not stand around it: must have none, or one at each "
          "end and no comma between",
          where, cells.size() + 1);
    cells.push_back(trimmed(cell));
    begin = end + 1;
  }
  return cells;
}

/// "flow [ml/s]" -> "flow", "ml/s"
std::pair<std::string, std::string> name_and_unit(const std::string& heading) {
  const auto open = heading.find('[');
  if (open == std::string::npos || heading.back() != ']') return {heading, ""};
  return {trimmed(heading.substr(0, open)), trimmed(heading.substr(open + 1, heading.size() - open - 2))};
}

bool skipped(const std::string& line) {
  const std::string content = trimmed(line);
  return content.empty() || content.front() == '#';
}

/// What spreadsheets write in front of UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr std::uintmax_t largest_table = 100'000'000;  // bytes

/// One column whose heading has semicolons is a table of another dialect.
void check_separator(const std::string& file, int line, const std::vector<std::string>& headings) {
  if (headings.size() == 1 && headings.front().find_first_of(";\t") != std::string::npos)
    throw input_error("{}:{}: columns are separated by {}: must be commas, and numbers have points (0.5)", file, line,
                      headings.front().find(';') != std::string::npos ? "semicolons" : "tabulators");
}

/// Up to the digits that a table is written with.
bool agree(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double rounding = 1e-5;
  for (std::size_t row = 0; row < a.size(); ++row)
    if (std::abs(a[row] - b[row]) > rounding * std::max(std::abs(a[row]), std::abs(b[row]))) return false;
  return true;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, TableOf by) : file_(file.string()), by_(by) {
  std::ifstream in = input_stream(file, std::ios::in, largest_table);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    if (skipped(text)) continue;
    if (!is_utf8(text)) throw input_error("{}:{}: is not UTF-8; save the file in that encoding", file_, line);
    auto cells = split(text, fmt::format("{}:{}", file_, line));
    if (columns_.empty()) {
      take_headings(cells, line);
      continue;
    }
    if (cells.size() != columns_.size())
      throw input_error("{}:{}: cells in this row: {}, columns: {}{}", file_, line, cells.size(), columns_.size(),
                        cells.size() > columns_.size() ? " (numbers have points, not commas: 0.5)" : "");
    lines_.push_back(line);
    cells_.push_back(std::move(cells));
  }
  if (cells_.empty()) throw input_error("{}: has no rows", file_);
}

void CsvTable::take_headings(const std::vector<std::string>& cells, int line) {
  check_separator(file_, line, cells);
  std::set<std::pair<std::string, std::string>> seen;
  for (const auto& heading : cells) {
    auto [name, unit] = name_and_unit(heading);
    if (!name.empty() && !seen.emplace(name, unit).second)
      throw input_error("{}:{}: has two columns '{}': leave one of them out", file_, line, heading);
    columns_.push_back(std::move(name));
    units_.push_back(std::move(unit));
  }
}

bool CsvTable::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::string CsvTable::unit(std::string_view column) const {
  return units_[index(column)];
}

std::string CsvTable::where(std::size_t row) const {
  return fmt::format("{}:{}", file_, lines_[row]);
}

std::size_t CsvTable::index(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end())
    throw input_error("{}: has no column '{}'; its columns are {}", file_, column, fmt::join(columns_, ", "));
  return static_cast<std::size_t>(found - columns_.begin());
}

std::vector<std::size_t> CsvTable::copies(std::size_t column) const {
  std::vector<std::size_t> found;
  for (std::size_t other = column + 1; other < columns_.size(); ++other)
    if (columns_[other] == columns_[column]) found.push_back(other);
  return found;
}

std::size_t CsvTable::single(std::string_view column) const {
  const std::size_t at = index(column);
  if (by_ == TableOf::person && !copies(at).empty())
    throw input_error("{}: has two columns '{}': leave one of them out", file_, column);
  return at;
}

std::vector<std::string> CsvTable::texts(std::string_view column) const {
  const std::size_t at = single(column);
  std::vector<std::string> values;
  for (const auto& row : cells_) values.push_back(row[at]);
  return values;
}

std::vector<std::string> CsvTable::names(std::string_view column) const {
  std::vector<std::string> values = texts(column);
  for (std::size_t row = 0; row < values.size(); ++row)
    if (!values[row].empty() && !is_name(values[row]))
      throw input_error("{}: {}: '{}': {}", where(row), column, values[row], name_rule);
  return values;
}

std::vector<double> CsvTable::quantities(std::string_view column, const UnitSystem& units, Dimension dimension,
                                         const std::string& unit) const {
  const std::size_t at = index(column);
  check_stated(at, units, dimension, unit);
  std::vector<double> values = quantities_at(at, units, dimension, unit.empty() ? units_[at] : unit);
  for (const std::size_t copy : copies(at))
    if (by_ == TableOf::person && !agree(values, quantities_at(copy, units, dimension, units_[copy])))
      throw input_error("{}: has two columns '{}' of different values: leave one of them out", file_, column);
  return values;
}

void CsvTable::check_stated(std::size_t column, const UnitSystem& units, Dimension dimension,
                            const std::string& unit) const {
  const std::string& heading = units_[column];
  if (unit.empty() || heading.empty() || unit == heading) return;
  const double rounding = 1e-9;
  double stated = 0, asked = 0;
  try {
    stated = units.quantity("1 " + heading, dimension), asked = units.quantity("1 " + unit, dimension);
  } catch (const InputError& error) {
    throw input_error("{}: column '{}': {}", where(0), columns_[column], error.what());
  }
  if (std::abs(stated - asked) > rounding * std::abs(stated))
    throw input_error("{}: column '{}': is in {} by its heading, in {} by the case: must be the same, or stated once",
                      where(0), columns_[column], heading, unit);
}

std::vector<double> CsvTable::quantities_at(std::size_t column, const UnitSystem& units, Dimension dimension,
                                            const std::string& unit) const {
  std::vector<double> values = numbers_at(column);
  try {
    const double one = unit.empty() ? 1.0 : units.quantity("1 " + unit, dimension);
    for (double& value : values) value *= one;
  } catch (const InputError& error) {
    throw input_error("{}: column '{}': {}", where(0), columns_[column], error.what());
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  return numbers_at(single(column));
}

std::vector<double> CsvTable::numbers_at(std::size_t column) const {
  std::vector<double> values;
  for (const auto& row : cells_) {
    const std::string& text = row[column];
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (error != std::errc{} || last != end || !std::isfinite(value) || text.starts_with("+-"))
      throw input_error("{}: {}: '{}' is not a number", where(values.size()), columns_[column], text);
    if (by_ == TableOf::person && std::abs(value) > largest_given)
      throw input_error("{}: {}: {}: must be from -{:g} to {:g}", where(values.size()), columns_[column], text,
                        largest_given, largest_given);
    values.push_back(value);
  }
  return values;
}

}  // namespace tether
