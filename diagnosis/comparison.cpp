#include "diagnosis/comparison.hpp"

#include <fmt/format.h>

namespace tether {

Comparison compare(const Observations& data, const std::vector<std::string>& region_names, const RunResults& run) {
  Comparison comparison;
  for (const auto& source : data.lumen) comparison.sources.push_back(compare(*source, region_names, run.motion));
  for (const Trace& trace : data.traces) comparison.traces.push_back(compare(trace, run.trace(trace)));
  Eigen::Index first = 0;
  for (const VelocitySeries& series : data.velocities) {
    comparison.velocities.push_back(compare(series, run.velocity, first));
    first += series.points().cols();
  }
  return comparison;
}

std::vector<std::string> sentences_of(const Comparison& comparison) {
  std::vector<std::string> all;
  if (!comparison.run.is_evidence())
    all.push_back(fmt::format(
        "NO EVIDENCE: this run was pulled toward the data (observer.gain {:g} 1/s), which hides what the model lacks",
        comparison.run.observer_gain));
  for (const SourceDiscrepancy& source : comparison.sources) {
    for (const bool held_out : {false, true})
      for (std::string& sentence : sentences_of(judge(source, held_out), source, held_out, comparison.units))
        all.push_back(std::move(sentence));
    if (!source.outside.empty())
      all.push_back(
          fmt::format("{}: {} of {} frames are outside the run", source.name, source.outside.size(), source.frames()));
  }
  for (const TraceDiscrepancy& trace : comparison.traces) all.push_back(sentence_of(trace, comparison.units));
  for (const VelocityDiscrepancy& velocity : comparison.velocities)
    for (std::string& sentence : sentences_of(velocity, comparison.units)) all.push_back(std::move(sentence));
  return all;
}

}  // namespace tether
