#include "batch/job_cases.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"
#include "common/config/named_path.hpp"
#include "common/config/overlay.hpp"
#include "common/config/yaml_tree.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

JobCase job_case(const std::string& name, const fs::path& file) {
  return {name, fs::absolute(named_path({}, file)).string()};
}

/// NAME/case.yaml is the case of NAME, any other file that of its own name.
std::string name_of_case(const fs::path& file) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  return (whole.filename() == "case.yaml" ? whole.parent_path().filename() : whole.stem()).string();
}

std::vector<JobCase> cases_in(const fs::path& folder) {
  std::vector<JobCase> cases;
  const auto add = [&](const fs::path& file) { cases.push_back(job_case(name_of_case(file), file)); };
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (entry.is_regular_file() && path.extension() == ".yaml") add(path);
    if (entry.is_directory() && fs::is_regular_file(path / "case.yaml")) add(path / "case.yaml");
  }
  std::sort(cases.begin(), cases.end(), [](const JobCase& a, const JobCase& b) { return a.name < b.name; });
  if (cases.empty()) throw input_error("{}: holds no case: no NAME.yaml, and no NAME/case.yaml", folder.string());
  return cases;
}

void check_names(const std::vector<JobCase>& cases, const std::string& place) {
  std::set<std::string> names;
  for (const JobCase& one : cases) {
    const std::string& here = one.row.empty() ? place : one.row;
    if (!is_file_name(one.name))
      throw input_error("{}: '{}' is to be a folder of results: its name {}", here, shortened(one.name),
                        file_name_rule);
    if (one.name == job_files || one.name == results_table)
      throw input_error("{}: no case may have the name '{}'", here, one.name);
    if (!names.insert(one.name).second) throw input_error("{}: two cases have the name '{}'", here, one.name);
  }
}

void check_columns(const CsvTable& rows, const std::string& table) {
  if (!rows.has("name")) throw input_error("{}: has no column `name`, one for each case", table);
  if (rows.has("base"))
    throw input_error("{}: has a column `base`: all its cases build on the case that is given", table);
  constexpr std::size_t most = 10'000;  // each becomes a file, and a job
  if (rows.rows() > most) throw input_error("{}: has {} cases: must be at most {}", table, rows.rows(), most);
}

bool is_bracketed(const std::string& cell) {
  return cell.front() == '[' || cell.front() == '{';
}

/// Whether it ends where the cell does: in brackets of its own it is then one item.
bool is_list_or_section(const std::string& cell) {
  try {
    const YamlNode whole = yaml_value("[" + cell + "]");
    return whole.items.size() == 1 && whole.items.front().kind != YamlNode::Kind::scalar;
  } catch (const InputError&) {
    return false;
  }
}

/// As YAML quotes it: nothing of it means anything else there.
std::string quoted(const std::string& cell) {
  std::string text = "\"";
  for (const char c : cell) text += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return text + "\"";
}

/// A cell as the text of a value in a case file.
std::string value_text(const std::string& cell, const std::string& unit) {
  if (!is_bracketed(cell)) return quoted(unit.empty() ? cell : cell + " " + unit);
  if (!unit.empty()) throw input_error("'{}': must be one number: the column has a unit, {}", shortened(cell), unit);
  if (!is_list_or_section(cell))
    throw input_error("'{}': must be a list or a section, and nothing beside it", shortened(cell));
  return cell;
}

/// A file or folder beside the case that all build on, by its whole path: the cases themselves stand elsewhere. A word
/// without folder or extension, and a number, is itself.
std::string of_base(const std::string& cell, const fs::path& base) {
  const bool may_be_path = cell.find('/') != std::string::npos || fs::path(cell).has_extension();
  const bool is_number = cell.find_first_not_of("0123456789.+-eE") == std::string::npos;
  if (!may_be_path || is_number) return cell;
  std::error_code none;
  const fs::path named = named_path(fs::absolute(base).parent_path(), cell);
  return fs::exists(named, none) ? named.string() : cell;
}

struct Column {
  std::string field, unit;
  std::vector<std::string> cells;
};

std::vector<Column> columns_of(const CsvTable& rows) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < rows.columns().size(); ++i)
    columns.push_back({rows.columns()[i], rows.units()[i], rows.texts(rows.columns()[i])});
  std::erase_if(columns, [](const Column& column) { return column.field == "name"; });
  return columns;
}

std::vector<Overlay::Value> values_of(const std::vector<Column>& columns, std::size_t row, const fs::path& base) {
  std::vector<Overlay::Value> values;
  for (const Column& column : columns) try {
      const std::string& cell = column.cells[row];
      if (cell.empty()) continue;
      const bool is_text = column.unit.empty() && !is_bracketed(cell);
      values.push_back({column.field, value_text(is_text ? of_base(cell, base) : cell, column.unit)});
    } catch (const InputError& error) {
      throw input_error("{}: {}", column.field, error.what());
    }
  return values;
}

/// The case's folder may be one for trying.
std::string without_folder(std::string line, const std::string& case_file) {
  const std::string folder = (fs::path(case_file).parent_path() / "").string();
  for (std::size_t at = line.find(folder); at != std::string::npos; at = line.find(folder))
    line.erase(at, folder.size());
  return line;
}

/// Without "FILE:LINE: " at its begin.
std::string without_place(const std::string& line, const std::string& file) {
  if (!line.starts_with(file)) return line;
  const std::size_t end = line.find_first_not_of("0123456789", file.size());
  return end != std::string::npos && line.substr(end, 2) == ": " ? line.substr(end + 2) : line;
}

}  // namespace

std::vector<JobCase> job_cases(const fs::path& given) {
  if (!fs::exists(given)) throw input_error("{}: no such file or folder", given.string());
  std::vector<JobCase> cases =
      fs::is_directory(given) ? cases_in(given) : std::vector{job_case(name_of_case(given), given)};
  check_names(cases, given.string());
  return cases;
}

std::vector<JobCase> job_cases_of_table(const fs::path& base, const fs::path& table, const fs::path& folder) {
  const CsvTable rows(table);
  check_columns(rows, table.string());
  std::vector<JobCase> cases;
  for (const std::string& name : rows.texts("name")) {
    cases.push_back(job_case(name, folder / (name + ".yaml")));
    cases.back().row = rows.where(cases.size() - 1);
  }
  check_names(cases, table.string());
  fs::create_directories(folder);
  const std::vector<Column> columns = columns_of(rows);
  for (std::size_t row = 0; row < cases.size(); ++row) try {
      write_overlay(cases[row].case_file, {fs::absolute(base), cases[row].name, "", values_of(columns, row, base)});
    } catch (const InputError& error) {
      throw input_error("{}: {}", cases[row].row, error.what());
    }
  return cases;
}

std::string told_by_row(const JobCase& one, const std::string& message) {
  if (one.row.empty()) return message;
  std::string told;
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);)
    told += (told.empty() ? "" : "\n") + one.row + ": " +
            without_folder(without_place(line, one.case_file + ":"), one.case_file);
  return told;
}

}  // namespace tether
