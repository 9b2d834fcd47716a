#include "batch/job_cases.hpp"

#include <algorithm>
#include <set>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/config/overlay.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

JobCase job_case(const std::string& name, const fs::path& file) {
  return {name, fs::absolute(file).lexically_normal().string()};
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
    if (!is_file_name(one.name))
      throw input_error("{}: '{}' is to be a folder of results: its name {}", place, one.name, file_name_rule);
    if (one.name == job_files || one.name == results_table)
      throw input_error("{}: no case may have the name '{}'", place, one.name);
    if (!names.insert(one.name).second) throw input_error("{}: two cases have the name '{}'", place, one.name);
  }
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
  if (!rows.has("name")) throw input_error("{}: has no column `name`, one for each case", table.string());
  const std::vector<std::string> names = rows.texts("name");
  std::vector<JobCase> cases;
  for (const std::string& name : names) cases.push_back(job_case(name, folder / (name + ".yaml")));
  check_names(cases, table.string());
  fs::create_directories(folder);
  std::vector<Overlay> overlays(cases.size(), Overlay{fs::absolute(base), {}, {}, {}});
  for (std::size_t column = 0; column < rows.columns().size(); ++column) {
    const std::string &field = rows.columns()[column], &unit = rows.units()[column];
    if (field == "name") continue;
    const std::vector<std::string> values = rows.texts(field);
    for (std::size_t row = 0; row < values.size(); ++row)
      if (!values[row].empty())
        overlays[row].values.push_back({field, unit.empty() ? values[row] : values[row] + " " + unit});
  }
  for (std::size_t row = 0; row < cases.size(); ++row) {
    overlays[row].name = names[row];
    write_overlay(cases[row].case_file, overlays[row]);
  }
  return cases;
}

}  // namespace tether
