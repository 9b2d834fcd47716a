#include "common/base/csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "common/base/error.hpp"
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

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(std::string_view(line).substr(begin, end - begin)));
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

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream in = input_stream(file, std::ios::in, largest_table);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    if (skipped(text)) continue;
    if (!is_utf8(text)) throw input_error("{}:{}: is not UTF-8; save the file in that encoding", file_, line);
    auto cells = split(text);
    if (columns_.empty()) {
      check_separator(file_, line, cells);
      for (const auto& heading : cells) {
        auto [name, unit] = name_and_unit(heading);
        columns_.push_back(std::move(name));
        units_.push_back(std::move(unit));
      }
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

std::vector<std::string> CsvTable::texts(std::string_view column) const {
  const std::size_t at = index(column);
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
  const std::string stated = unit.empty() ? this->unit(column) : unit;
  std::vector<double> values = numbers(column);
  try {
    const double one = stated.empty() ? 1.0 : units.quantity("1 " + stated, dimension);
    for (double& value : values) value *= one;
  } catch (const InputError& error) {
    throw input_error("{}: column '{}': {}", where(0), column, error.what());
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  std::vector<double> values;
  for (const auto& text : texts(column)) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (error != std::errc{} || last != end || !std::isfinite(value))
      throw input_error("{}: {}: '{}' is not a number", where(values.size()), column, text);
    values.push_back(value);
  }
  return values;
}

}  // namespace tether
