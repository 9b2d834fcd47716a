#include "common/io/pvd.hpp"

#include <cstdlib>
#include <fstream>

#include "common/base/error.hpp"

namespace tether {

namespace {

/// The value of name="value" in a line; empty if it is not there.
std::string attribute(const std::string& line, const std::string& name) {
  const std::size_t found = line.find(' ' + name + "=\"");
  if (found == std::string::npos) return {};
  const std::size_t start = found + name.size() + 3;
  return line.substr(start, line.find('"', start) - start);
}

}  // namespace

PvdSeries PvdSeries::resumed(std::filesystem::path path, double last_time) {
  PvdSeries series(path);
  std::ifstream file(path);
  if (!file) return series;
  bool is_collection = false;
  for (std::string line; std::getline(file, line);) {
    is_collection = is_collection || attribute(line, "type") == "Collection";
    if (line.find("<DataSet") == std::string::npos) continue;
    const double time = std::strtod(attribute(line, "timestep").c_str(), nullptr);
    if (time <= last_time) series.entries_.emplace_back(time, attribute(line, "file"));
  }
  if (!is_collection) throw input_error("{}: is not a ParaView collection", path.string());
  return series;
}

void PvdSeries::add(double time, const std::string& file) {
  entries_.emplace_back(time, file);
  const std::filesystem::path partial = path_.string() + ".part";
  std::ofstream out(partial);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [at, name] : entries_)
    out << fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", at, name);
  out << "</Collection>\n</VTKFile>\n";
  out.close();
  if (!out) throw run_error("{}: cannot be written", partial.string());
  std::filesystem::rename(partial, path_);
}

}  // namespace tether
