#include "common/io/pvd.hpp"

#include <vtkObject.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <regex>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/xml_tags.hpp"

namespace tether {

namespace {

using Element = vtkSmartPointer<vtkXMLDataElement>;

constexpr std::uintmax_t largest_series = 50'000'000;  ///< bytes: of 100,000 files with long names

/// Throws InputError for what VTK's parser would take long for.
void check_tags(const std::filesystem::path& path) {
  const std::string content = content_of(path, largest_series);
  XmlTags tags(path.string(), content);
  while (!tags.at_end()) tags.next();
}

/// The root of an XML file; null if it is none.
Element root_of(const std::filesystem::path& path) {
  check_tags(path);
  vtkObject::GlobalWarningDisplayOff();  // errors are reported by exceptions
  return Element::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
}

/// Of the DataSet with that number (from 0).
std::string attribute(vtkXMLDataElement& element, const char* name, const std::filesystem::path& path, int number) {
  const char* value = element.GetAttribute(name);
  if (value == nullptr || *value == '\0')
    throw input_error("{}: DataSet {} (from 0) states no {}", path.string(), number, name);
  return value;
}

double time_of(vtkXMLDataElement& element, const std::filesystem::path& path, int number) {
  const std::string text = attribute(element, "timestep", path, number);
  double time = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, time);
  if (error != std::errc{} || last != end || !std::isfinite(time))
    throw input_error("{}: DataSet {} (from 0): timestep: '{}' is not a number", path.string(), number, text);
  return time;
}

/// A file that a series names.
bool is_there(const std::filesystem::path& series, const std::string& file) {
  std::error_code none;
  return std::filesystem::is_regular_file(series.parent_path() / file, none);
}

}  // namespace

PvdSeries PvdSeries::resumed(std::filesystem::path path, double last_time) {
  PvdSeries series(path);
  if (!std::filesystem::exists(path)) return series;
  const Element root = root_of(path);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (collection == nullptr) throw input_error("{}: is not a ParaView collection", path.string());
  for (int i = 0, number = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement& element = *collection->GetNestedElement(i);
    if (std::string_view(element.GetName()) != "DataSet") continue;
    const double time = time_of(element, path, number);
    if (time <= last_time) series.entries_.emplace_back(time, attribute(element, "file", path, number));
    ++number;
  }
  return series;
}

PvdSeries PvdSeries::rescued(const std::filesystem::path& path, double last_time) {
  try {
    PvdSeries series = resumed(path, last_time);
    const std::size_t gone =
        std::erase_if(series.entries_, [&](const auto& entry) { return !is_there(path, entry.second); });
    if (gone > 0)
      fmt::print(stderr, "{}: {} of the files that it lists are gone: written anew without them\n", path.string(),
                 gone);
    return series;
  } catch (const InputError& error) {
    PvdSeries series(path);
    std::ifstream file(path);
    const std::regex entry("<DataSet timestep=\"([-+.e0-9]+)\" part=\"0\" file=\"([^\"]+)\"/>");
    std::smatch found;
    for (std::string line; std::getline(file, line);)
      if (std::regex_match(line, found, entry) && std::stod(found[1]) <= last_time && is_there(path, found[2]))
        series.entries_.emplace_back(std::stod(found[1]), found[2]);
    fmt::print(stderr, "{}; it is written anew, with the {} files that it still names\n", error.what(),
               series.entries_.size());
    return series;
  }
}

PvdSeries PvdSeries::rescued_before(const std::filesystem::path& path, double time) {
  return rescued(path, time - std::max(1e-12 * std::abs(time), 1e-300));
}

void PvdSeries::add(double time, const std::string& file) {
  entries_.emplace_back(time, file);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [at, name] : entries_)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", at, name);
  write_whole(path_, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace tether
