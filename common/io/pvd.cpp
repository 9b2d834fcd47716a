#include "common/io/pvd.hpp"

#include <fstream>
#include <regex>

#include "common/base/error.hpp"

namespace tether {

PvdSeries PvdSeries::resumed(std::filesystem::path path, double last_time) {
  PvdSeries series(path);
  std::ifstream file(path);
  if (!file) return series;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.find("type=\"Collection\"") == std::string::npos)
    throw input_error("{}: is not a ParaView collection", path.string());
  static const std::regex entry(R"re(<DataSet timestep="([^"]+)"[^>]* file="([^"]+)")re");
  for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it)
    if (const double time = std::stod((*it)[1]); time <= last_time) series.entries_.emplace_back(time, (*it)[2]);
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
