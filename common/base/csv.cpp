#include "common/base/csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "common/base/error.hpp"
#include "common/base/given_number.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"

namespace tether {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Without any, or with one at each end.
bool has_right_quotes(std::string_view cell) {
  const auto first = cell.find('"');
  if (first == std::string_view::npos) return true;
  const auto second = cell.find('"', first + 1);
  constexpr std::string_view blank = " \t\r";
  return first == cell.find_first_not_of(blank) && second == cell.find_last_not_of(blank);
}

/// "flow [ml/s]" -> "flow", "ml/s"
std::pair<std::string, std::string> name_and_unit(std::string_view heading) {
  const auto open = heading.find('[');
  if (open == std::string_view::npos || heading.back() != ']') return {std::string(heading), ""};
  return {std::string(trimmed(heading.substr(0, open))),
          std::string(trimmed(heading.substr(open + 1, heading.size() - open - 2)))};
}

bool skipped(std::string_view line) {
  const std::string_view content = trimmed(line);
  return content.empty() || content.front() == '#';
}

/// What spreadsheets write in front of UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr std::uintmax_t largest_table = 100'000'000;  // bytes
constexpr std::size_t longest_line = 1'000'000;        // bytes
constexpr std::size_t most_columns = 10'000;
constexpr std::size_t most_cells = 20'000'000;  // of velocities: thousands of points at hundreds of times

/// One column whose heading has semicolons is a table of another dialect.
void check_separator(const std::string& file, int line, std::string_view only_heading) {
  if (only_heading.find_first_of(";\t") != std::string_view::npos)
    throw input_error("{}:{}: columns are separated by {}: must be commas, and numbers have points (0.5)", file, line,
                      only_heading.find(';') != std::string_view::npos ? "semicolons" : "tabulators");
}

/// Up to the digits that a table is written with.
bool agree(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double rounding = 1e-5;
  for (std::size_t row = 0; row < a.size(); ++row)
    if (std::abs(a[row] - b[row]) > rounding * std::max(std::abs(a[row]), std::abs(b[row]))) return false;
  return true;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, TableOf by)
    : file_(file.string()), by_(by), text_(content_of(file, largest_table)) {
  std::size_t begin = text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  for (int line = 1; begin < text_.size(); ++line) {
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    take_line(begin, end, line);
    begin = end + 1;
  }
  if (lines_.empty()) throw input_error("{}: has no rows", file_);
}

void CsvTable::take_line(std::size_t begin, std::size_t end, int line) {
  const std::string_view text = std::string_view(text_).substr(begin, end - begin);
  if (skipped(text)) return;
  if (text.size() > longest_line)
    throw input_error("{}:{}: the line has {} bytes: must be at most {}", file_, line, text.size(), longest_line);
  if (!is_utf8(text)) throw input_error("{}:{}: is not UTF-8; save the file in that encoding", file_, line);
  const std::size_t cells = split(begin, end, line);
  if (columns_.empty())
    take_headings(line);
  else
    take_row(cells, line);
}

std::size_t CsvTable::split(std::size_t begin, std::size_t end, int line) {
  std::size_t cells = 0;
  for (const std::string_view all = std::string_view(text_).substr(0, end); begin <= end; ++cells) {
    const std::size_t next = std::min(all.find(',', begin), end);
    if (!has_right_quotes(all.substr(begin, next - begin)))
      throw input_error(
          "{}:{}: cell {} has a quotation mark that does not stand around it: must have none, or one at each "
          "end and no comma between",
          file_, line, cells + 1);
    begins_.push_back(static_cast<std::uint32_t>(begin));
    begin = next + 1;
  }
  begins_.push_back(static_cast<std::uint32_t>(begin));
  return cells;
}

void CsvTable::take_headings(int line) {
  const std::size_t count = begins_.size() - 1;
  if (count > most_columns)
    throw input_error("{}:{}: has {} columns: must be at most {}", file_, line, count, most_columns);
  if (count == 1) check_separator(file_, line, cell(0, 0));
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t column = 0; column < count; ++column) {
    const std::string_view heading = cell(0, column);
    auto [name, unit] = name_and_unit(heading);
    if (!name.empty() && !seen.emplace(name, unit).second)
      throw input_error("{}:{}: has two columns '{}': leave one of them out", file_, line, shortened(heading));
    columns_.push_back(std::move(name));
    units_.push_back(std::move(unit));
  }
  begins_.clear();
  const std::size_t most = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 1;
  lines_.reserve(std::min(most, most_cells / count + 1));
  begins_.reserve(lines_.capacity() * (count + 1));
}

void CsvTable::take_row(std::size_t cells, int line) {
  if (cells != columns_.size())
    throw input_error("{}:{}: cells in this row: {}, columns: {}{}", file_, line, cells, columns_.size(),
                      cells > columns_.size() ? " (numbers have points, not commas: 0.5)" : "");
  lines_.push_back(line);
  if (lines_.size() * columns_.size() > most_cells)
    throw input_error("{}:{}: the table has more than {} cells up to here: must be at most so many", file_, line,
                      most_cells);
}

std::string_view CsvTable::cell(std::size_t row, std::size_t column) const {
  const std::size_t columns = columns_.empty() ? begins_.size() - 1 : columns_.size();
  const std::uint32_t* begin = begins_.data() + row * (columns + 1) + column;
  return trimmed(std::string_view(text_).substr(begin[0], begin[1] - 1 - begin[0]));
}

std::string CsvTable::listed_columns() const {
  constexpr std::size_t most = 500;
  return shortened(fmt::format("{}", fmt::join(columns_, ", ")), most);
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
    throw input_error("{}: has no column '{}'; its columns are {}", file_, shortened(column), listed_columns());
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
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) values.emplace_back(cell(row, at));
  return values;
}

std::vector<std::string> CsvTable::names(std::string_view column) const {
  std::vector<std::string> values = texts(column);
  for (std::size_t row = 0; row < values.size(); ++row)
    if (!values[row].empty() && !is_name(values[row]))
      throw input_error("{}: {}: '{}': {}", where(row), column, shortened(values[row]), name_rule);
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
    throw input_error("{}: column '{}': {}", where(0), columns_[column], shortened(error.what(), 200));
  }
  if (std::abs(stated - asked) > rounding * std::abs(stated))
    throw input_error("{}: column '{}': is in {} by its heading, in {} by the case: must be the same, or stated once",
                      where(0), columns_[column], shortened(heading), unit);
}

std::vector<double> CsvTable::quantities_at(std::size_t column, const UnitSystem& units, Dimension dimension,
                                            const std::string& unit) const {
  std::vector<double> values = numbers_at(column);
  try {
    const double one = unit.empty() ? 1.0 : units.quantity("1 " + unit, dimension);
    for (double& value : values) value *= one;
  } catch (const InputError& error) {
    throw input_error("{}: column '{}': {}", where(0), columns_[column], shortened(error.what(), 200));
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  return numbers_at(single(column));
}

std::vector<double> CsvTable::numbers_at(std::size_t column) const {
  std::vector<double> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view text = cell(row, column);
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (error != std::errc{} || last != end || !std::isfinite(value) || text.starts_with("+-"))
      throw input_error("{}: {}: '{}' is not a number", where(row), columns_[column], shortened(text));
    if (by_ == TableOf::person && std::abs(value) > largest_given)
      throw input_error("{}: {}: {}: must be from -{:g} to {:g}", where(row), columns_[column], shortened(text),
                        largest_given, largest_given);
    values.push_back(value);
  }
  return values;
}

}  // namespace tether
