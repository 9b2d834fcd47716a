#include "observation_manager/measurements/lumen_source.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "observation_manager/measurements/surface_check.hpp"

namespace tether {
namespace {

/// For each node none, or why the case does not want it observed.
std::vector<Exclusion> excluded_nodes(const LumenDataCase& data, const LumenSurface& lumen, const LumenSource& source) {
  std::vector<bool> masked(lumen.region_names.size(), false);
  for (const std::string& name : data.masked_regions) {
    const auto found = std::find(lumen.region_names.begin(), lumen.region_names.end(), name);
    if (found == lumen.region_names.end())
      throw input_error("{}: {}: the wall has no such region; it has: {}", source.where("masked_regions"), name,
                        fmt::join(lumen.region_names, ", "));
    masked[static_cast<std::size_t>(found - lumen.region_names.begin())] = true;
  }
  std::vector<Exclusion> excluded;
  for (Eigen::Index node = 0; node < lumen.points.cols(); ++node) {
    const int region = lumen.region[static_cast<std::size_t>(node)];
    const bool near_end = lumen.from_inlet[node] < data.inlet_band || lumen.from_outlet[node] < data.outlet_band;
    excluded.push_back(region >= 0 && masked[static_cast<std::size_t>(region)] ? Exclusion::masked
                       : near_end                                              ? Exclusion::near_end
                                                                               : Exclusion::none);
  }
  if (std::count(excluded.begin(), excluded.end(), Exclusion::none) == 0)
    throw input_error("{}: masked regions and bands leave no place of the lumen to observe",
                      source.file.where(source.field));
  return excluded;
}

}  // namespace

SourceSettings settings_of(const LumenDataCase& data, double period, const LumenSurface& lumen,
                           const LumenSource& source) {
  SourceSettings settings;
  settings.name = source.field.substr(source.field.rfind('.') + 1);
  settings.period = period;
  settings.time_tolerance = 0.5 * source.file.common().time.step;
  if (data.trust_distance) settings.trust_distance = *data.trust_distance;
  settings.of_node = excluded_nodes(data, lumen, source);
  settings.region = lumen.region;
  settings.noise = noise_of(data.noise);
  settings.outward = data.correction.faults.outward();
  if (const double radius = mean_radius({lumen.points, lumen.triangles}); std::abs(settings.outward) > 0.5 * radius)
    throw input_error("{}: {:g} is more than half of the vessel's mean radius, {:.3g}",
                      source.where("correction.outward"), settings.outward, radius);
  return settings;
}

bool holds(const std::vector<double>& numbers, double number) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// What the case takes off the data.
void note_corrections(std::vector<Note>& notes, const LumenDataCase& data, const CaseFile& file) {
  for (std::string& note : data.correction.faults.notes(file.units().symbol(dimension::length)))
    notes.push_back({"", std::move(note)});
  if (!data.left_out.empty())
    notes.push_back({"", fmt::format("left out: frames {:g}", fmt::join(data.left_out, ", "))});
}

void check_range(double first, double last, double period, const LumenSource& source) {
  const TimeCase& run = source.file.common().time;
  if (period > 0 || std::isnan(first) || (first <= run.end && last >= run.start)) return;
  throw input_error("{}: its frames are from {:g} to {:g}, the run is from {:g} to {:g}: period or time_shift?",
                    source.file.where(source.field), first, last, run.start, run.end);
}

double reach_of(const LumenDataCase& data, const LumenSurface& lumen) {
  return data.trust_distance.value_or(mean_radius({lumen.points, lumen.triangles}));
}

std::string share_text(double share, double reach) {
  return fmt::format("{:.0f} % of the places of the lumen that it faces lie within {:.3g} of it", 100 * share, reach);
}

}  // namespace tether
