#include "observation_manager/measurements/observations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "observation_manager/measurements/lumen_kinds.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "observation_manager/measurements/surface_check.hpp"

namespace tether {
namespace {

/// Some place where a velocity was measured must lie in the imaged lumen; how many do not is noted.
void check_overlap(const Measurement& source, const SignedSurface& lumen, const CaseFile& file,
                   std::vector<std::string>& notes) {
  const Points points = source.velocity_points();
  const MeasurementFacts facts = source.facts();
  const std::vector<Closest> found = lumen.closest(points);
  const auto outside = std::count_if(found.begin(), found.end(), [](const Closest& c) { return c.distance < 0; });
  const std::string said = fmt::format("{} of {} points lie outside the imaged lumen", outside, found.size());
  if (outside == static_cast<std::ptrdiff_t>(found.size()))
    throw input_error("{}: does not overlap the model: {}; {}", file.where(facts.field()), said,
                      placement(points, lumen.surface().points));
  if (outside > 0)
    notes.push_back(
        fmt::format("{}: {}: nothing is observed there while the lumen does not reach them", facts.name, said));
}

void check_overlaps(Observations& data, const LumenSurface& lumen, const CaseFile& file) {
  if (data.points().cols() == 0) return;
  const SignedSurface closed(closed_by_fans(lumen));
  for (const Measurement* source : data.all())
    if (source->velocity_points().cols() > 0) check_overlap(*source, closed, file, data.flow_notes);
}

}  // namespace

std::vector<const Measurement*> Observations::all() const {
  std::vector<const Measurement*> sources;
  for (const auto& series : lumen) sources.push_back(series.get());
  for (const Measurement* source : FlowObservations::all()) sources.push_back(source);
  return sources;
}

std::vector<Sample> Observations::observe(const Points& x, double time) const {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < lumen.size(); ++i)
    for (Sample& sample : lumen[i]->observe(x, time)) {
      sample.source = static_cast<int>(i);
      samples.push_back(sample);
    }
  return samples;
}

std::vector<std::string> Observations::notes() const {
  std::vector<std::string> all;
  for (const auto& series : lumen)
    for (const std::string& note : told(series->notes())) all.push_back(series->settings().name + ": " + note);
  all.insert(all.end(), flow_notes.begin(), flow_notes.end());
  return all;
}

std::uint64_t Observations::content() const {
  std::uint64_t hash = 0;
  for (const Measurement* source : all()) {
    const std::uint64_t content = source->content();
    hash = hash_bytes(&content, sizeof content, hash);
  }
  return hash;
}

Observations load_observations(const ObservationsCase& given, const LumenSurface& lumen, const CaseFile& file) {
  Observations result{
      load_flow_observations(given, file), {}, {}, error_regions(given.regions, lumen.region_names, file)};
  for (const auto& section : given.sections()) {
    if (section->kind().load_on_lumen != nullptr) section->kind().load_on_lumen(*section, lumen, file, result);
    for (const LumenKind& known : lumen_kinds())
      if (&known.kind == &section->kind()) known.load(*section, lumen, file, result);
  }
  check_overlaps(result, lumen, file);
  return result;
}

}  // namespace tether
