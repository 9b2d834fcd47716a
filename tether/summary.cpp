#include "tether/summary.hpp"

#include <fmt/ranges.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"

namespace tether {
namespace {

using Json = nlohmann::json;

std::string cost(const Json& s) {
  return fmt::format("  {} steps in {:.1f} s: {:.3f} s a step; CPU {:.1f} s, memory {:.0f} MB over all processes\n",
                     s.at("steps").get<int>(), s.at("wall_seconds").get<double>(),
                     s.at("seconds_per_step").get<double>(), s.at("cpu_seconds").at("total").get<double>(),
                     s.at("peak_memory_mb").at("total").get<double>());
}

std::string pressure(const Json& s) {
  const Json& p = s.at("pressure");
  if (p.is_null()) return "";
  const double image = p.value("relative_to_mmHg", 0.0);
  return fmt::format(
      "  pressure       {:.1f} .. {:.1f} mmHg{}\n", image + p.at("min_mmHg").get<double>(),
      image + p.at("max_mmHg").get<double>(),
      image == 0 ? "" : fmt::format(" ({:.1f} in the image, to which other figures are relative)", image));
}

std::string observer(const Json& s) {
  if (!s.contains("observer")) return "";
  return fmt::format(
      "  observer       moved the lumen by at most {:.2g} mm a step: this run follows the data, and is no evidence for "
      "the "
      "model\n",
      s.at("observer").at("largest_correction_mm").get<double>());
}

std::string coupling(const Json& s) {
  const Json& c = s.at("coupling_iterations");
  return fmt::format("  coupling       {:.2f} evaluations a step, at most {:.0f} ({})\n", c.at("mean").get<double>(),
                     c.at("max").get<double>(), s.at("coupling_method").get<std::string>());
}

}  // namespace

std::string summary_text(const std::filesystem::path& output) {
  const auto path = output / "summary.json";
  std::ifstream file(path);
  try {
    const Json s = Json::parse(file);
    return cost(s) + pressure(s) +
           fmt::format("  displacement   at most {:.3g} mm\n", s.at("max_displacement_mm").get<double>()) +
           coupling(s) + observer(s) +
           fmt::format("  mass balance   off by at most {:.1e} {}\n", s.at("mass_balance_error_max").get<double>(),
                       s.at("units").at("flow").get<std::string>());
  } catch (const Json::exception& error) {
    throw run_error("{}: is not a run's summary: {}", path.string(), error.what());
  }
}

std::string where_to_look(const std::filesystem::path& output, const std::vector<std::string>& plots) {
  std::string text = fmt::format("In {}:\n", output.string());
  if (!plots.empty()) text += fmt::format("  plots/             {}\n", fmt::join(plots, ", "));
  for (const auto& [name, meaning] :
       {std::pair{"fluid.pvd", "the blood over time, for ParaView"},
        std::pair{"solid.pvd", "the wall over time, for ParaView"},
        std::pair{"timeseries.csv", "pressures, flows, displacements, forces at every step"},
        std::pair{"summary.json", "what was run, and how it went"}})
    if (std::filesystem::exists(output / name)) text += fmt::format("  {:<18} {}\n", name, meaning);
  return text;
}

}  // namespace tether
