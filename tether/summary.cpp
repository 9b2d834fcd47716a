#include "tether/summary.hpp"

#include <fmt/ranges.h>

#include <filesystem>

namespace tether {
namespace {

std::string cost(const RunSummary& s) {
  return fmt::format(
      "  {} steps in {:.1f} s, {:.1f} of CPU: {:.3f} and {:.3f} s a step; memory {:.0f} MB over all processes\n",
      s.steps, s.wall_seconds, s.loop_cpu_seconds.at("total"), s.seconds_per_step, s.cpu_seconds_per_step,
      s.peak_memory_mb.at("total"));
}

std::string pressure(const std::optional<PressureRange>& p) {
  if (!p) return "";
  const double image = p->relative_to_mmhg;
  return fmt::format(
      "  pressure       {:.1f} .. {:.1f} mmHg{}\n", image + p->min_mmhg, image + p->max_mmhg,
      image == 0 ? "" : fmt::format(" ({:.1f} in the image, to which other figures are relative)", image));
}

std::string observer(const std::optional<ObserverWork>& observer) {
  if (!observer) return "";
  return fmt::format(
      "  observer       moved the lumen by at most {:.2g} mm a step: this run follows the data, and is no evidence for "
      "the model\n",
      observer->largest_correction_mm);
}

std::string coupling(const RunSummary& s) {
  return fmt::format("  coupling       {:.2f} evaluations a step, at most {:.0f} ({})\n", s.coupling_iterations.mean,
                     s.coupling_iterations.max, s.coupling_method);
}

std::string rest(const std::optional<RestState>& rest) {
  if (!rest || !rest->held) return "";
  return fmt::format(
      "  in the image   the surroundings hold {:.1f} % of the pressure's forces; most, {:.2g} of the pressure, in "
      "region {}\n",
      100 * rest->held->share, rest->held->largest, rest->held->region);
}

std::string periodicity(const std::optional<Periodicity>& p) {
  if (!p || p->beats.empty()) return "";
  const BeatChange& last = p->beats.back();
  const std::string since = p->periodic_from ? fmt::format("since beat {}", *p->periodic_from) : "not yet";
  return fmt::format(
      "  periodic       {}: beat {} differs from the one before by at most {:.2g} % in pressure, {:.2g} % in volume\n",
      since, last.beat, 100 * last.pressure, 100 * last.volume);
}

}  // namespace

std::string text_of(const RunSummary& s) {
  return cost(s) + pressure(s.pressure) + fmt::format("  displacement   at most {:.3g} mm\n", s.max_displacement_mm) +
         coupling(s) + rest(s.rest) + periodicity(s.periodicity) + observer(s.observer) +
         fmt::format("  mass balance   off by at most {:.1e} {}\n", s.mass_balance_error_max, s.units.flow);
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
