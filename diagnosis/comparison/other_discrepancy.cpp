#include "diagnosis/comparison/other_discrepancy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// Of sums so far, one more.
void add(OtherStatistics& sums, double difference) {
  ++sums.used;
  sums.rms += difference * difference, sums.bias += difference;
  sums.largest = std::max(sums.largest, std::abs(difference));
}

void divide(OtherStatistics& sums) {
  if (sums.used == 0) return;
  sums.rms = std::sqrt(sums.rms / sums.used), sums.bias /= sums.used;
}

}  // namespace

OtherDiscrepancy compare(const Measurement& data, const FinishedMotion& run, const UnitSystem& units) {
  const MeasurementFacts facts = data.facts();
  OtherDiscrepancy result{facts.name, facts.kind.name, units.symbol(facts.dimension), facts.noise, {}, {}};
  for (const MeasuredPart& part : data.parts(run))
    for (const Datum& datum : data.data(run, part))
      if (datum.is_seen) add(datum.held_out ? result.held_out : result.training, datum.residual);
  divide(result.training);
  divide(result.held_out);
  return result;
}

std::vector<std::string> sentences_of(const OtherDiscrepancy& other) {
  std::vector<std::string> all;
  for (const bool held_out : {false, true}) {
    const OtherStatistics& s = held_out ? other.held_out : other.training;
    if (s.used == 0) continue;
    const double unit = other.noise.deviation;
    const std::string noise = unit > 0 ? fmt::format(" ({:.1f} times the noise)", s.rms / unit) : "";
    all.push_back(fmt::format("{}{} ({}): {:.3g} {} off in root mean square over {} values{}", other.name,
                              held_out ? ", held out" : "", other.kind, s.rms, other.unit, s.used, noise));
  }
  if (all.empty()) all.push_back(fmt::format("{} ({}): the run has nothing to set against it", other.name, other.kind));
  return all;
}

}  // namespace tether
