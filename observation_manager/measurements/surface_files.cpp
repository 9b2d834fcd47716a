#include "observation_manager/measurements/surface_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/given_number.hpp"
#include "common/base/lower_case.hpp"
#include "common/base/shortened.hpp"
#include "common/config/input_files.hpp"
#include "common/io/pvd.hpp"
#include "observation_manager/measurements/stated_unit.hpp"
#include "vessel/mesh_file.hpp"

namespace tether {
namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// More than any series has: each of them would be read.
void check_number(std::size_t files, const std::filesystem::path& list) {
  constexpr std::size_t most = 5000;
  if (files > most) throw input_error("{}: has {} surfaces: must be at most {}", list.string(), files, most);
}

/// As messages name it: longer than any that there can be, it is the list that is wrong.
std::string shown(const std::filesystem::path& file) {
  constexpr std::size_t most = 1000;
  return shortened(file.string(), most);
}

std::vector<TimedFile> listed_in_table(const std::filesystem::path& list, const UnitSystem& units) {
  const CsvTable table(list);
  check_unit_of_time(table, false);
  check_number(table.rows(), list);
  const std::vector<std::string> names = table.texts("file");
  const std::vector<double> times = table.quantities("time", units, dimension::time);
  std::vector<TimedFile> files;
  for (std::size_t row = 0; row < names.size(); ++row) {
    if (names[row].empty()) throw input_error("{}: file: '': must be the name of a surface's file", table.where(row));
    files.push_back({list.parent_path() / names[row], times[row], table.where(row)});
  }
  return files;
}

std::vector<TimedFile> listed_in_series(const std::filesystem::path& list) {
  const PvdSeries series = PvdSeries::resumed(list, std::numeric_limits<double>::infinity());
  std::vector<TimedFile> files;
  for (const auto& [time, name] : series.entries()) {
    if (std::abs(time) > largest_given)
      throw input_error("{}: timestep: {}: must be from -{:g} to {:g}", list.string(), time, largest_given,
                        largest_given);
    files.push_back({list.parent_path() / name, time, list.string()});
  }
  if (files.empty()) throw input_error("{}: lists no file", list.string());
  return files;
}

std::vector<TimedFile> found_in_folder(const SurfacesCase& given) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(given.folder))
    if (matches(entry.path().filename().string(), given.pattern)) names.push_back(entry.path().filename().string());
  if (names.empty()) throw input_error("{}: holds no file whose name matches {}", given.folder.string(), given.pattern);
  std::sort(names.begin(), names.end(), in_order_of_numbers);
  std::vector<TimedFile> files;
  for (const std::string& name : names)
    files.push_back({given.folder / name, *given.first_time + *given.interval * static_cast<double>(files.size()),
                     (given.folder / name).string()});
  return files;
}

void check_is_file(const TimedFile& given) {
  std::error_code unknown;  // its name may be too long for the system
  const std::filesystem::file_status status = std::filesystem::status(given.file, unknown);
  if (!std::filesystem::exists(status)) throw input_error("{}: {} does not exist", given.where, shown(given.file));
  if (!std::filesystem::is_regular_file(status))
    throw input_error("{}: {} is {}: must be a surface's file", given.where, shown(given.file),
                      std::filesystem::is_directory(status) ? "a folder" : "a device or a pipe");
}

/// A name that is written otherwise than it reads, as by &#95;: what results depend on would not be seen.
std::vector<TimedFile> plainly_named(std::vector<TimedFile> files, const std::filesystem::path& list) {
  check_number(files.size(), list);
  std::for_each(files.begin(), files.end(), check_is_file);
  const std::set<std::filesystem::path> seen = files_named_in(list);
  for (const TimedFile& file : files)
    if (!seen.contains(file.file))
      throw input_error(
          "{}: the name of {} must be written as it is, in UTF-8, without quotes or &#...; of its characters",
          file.where, shown(file.file));
  return files;
}

std::vector<TimedFile> listed(const SurfacesCase& given, const UnitSystem& units) {
  if (!given.folder.empty()) return found_in_folder(given);
  const std::string extension = lower_case(given.file.extension().string());
  if (extension == ".pvd") return plainly_named(listed_in_series(given.file), given.file);
  if (extension == ".csv") return plainly_named(listed_in_table(given.file, units), given.file);
  return {{given.file, std::numeric_limits<double>::quiet_NaN(), given.file.string()}};
}

void check_times(const std::vector<TimedFile>& files, double period) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    const auto& [file, time, where] = files[i];
    if (!(time > files[i - 1].time))
      throw input_error("{}: the time {:g} of {} does not come after {:g}", where, time, file.filename().string(),
                        files[i - 1].time);
    if (period > 0 && time > files.front().time + period * (1 - 1e-9))
      throw input_error("{}: the time {:g} of {} lies beyond one period of {:g}: it would be the first frame again",
                        where, time, file.filename().string(), period);
  }
}

}  // namespace

/// The latest * takes one character more wherever what follows it does not fit: at most name times pattern steps.
bool matches(std::string_view name, std::string_view pattern) {
  std::size_t n = 0, p = 0, star = std::string_view::npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*')
      star = p++, taken = n;
    else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]))
      ++p, ++n;
    else if (star != std::string_view::npos)
      p = star + 1, n = ++taken;
    else
      return false;
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool in_order_of_numbers(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number = [](const std::string& text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return text.substr(begin, at - begin);
      };
      const std::string m = number(a, i), n = number(b, j);
      if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i, ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<TimedFile> files_of(const SurfacesCase& given, const UnitSystem& units) {
  std::vector<TimedFile> files = listed(given, units);
  check_number(files.size(), given.folder.empty() ? given.file : given.folder);
  std::for_each(files.begin(), files.end(), check_is_file);
  check_times(files, given.period.value_or(0));
  for (TimedFile& file : files) file.time += given.data.time_shift;
  return files;
}

TriangleSurface read_surface(const std::filesystem::path& file, double scale) {
  MeshFile mesh = read_mesh_file(file);
  return {mesh.points * scale, std::move(mesh.triangles)};
}

}  // namespace tether
