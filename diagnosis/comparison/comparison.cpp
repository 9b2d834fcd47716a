#include "diagnosis/comparison/comparison.hpp"

#include <fmt/format.h>

#include <numbers>
#include <optional>

namespace tether {

Comparison compare(const Observations& data, const ErrorRegions& regions, const RunResults& run,
                   const UnitSystem& units) {
  Comparison comparison;
  comparison.units = units;
  for (const auto& source : data.lumen) comparison.sources.push_back(compare(*source, regions, run.motion));
  for (const Trace& trace : data.traces) comparison.traces.push_back(compare(trace, run.trace(trace)));
  Eigen::Index first = 0;
  for (const VelocitySeries& series : data.velocities) {
    comparison.velocities.push_back(compare(series, run.velocity, first));
    first += series.points().cols();
  }
  for (const auto& other : data.others) comparison.others.push_back(compare(*other, run.whole, units));
  return comparison;
}

namespace {

/// What is to be looked at before any physics.
std::string sentence_of(const Registration& found, const std::string& source, const UnitSystem& units) {
  const Vec3 by = found.motion.displacement, turned = found.motion.rotation;
  return fmt::format(
      "{}: CHECK THE REGISTRATION: even the frame closest to the imaged lumen lies {:.2g} mm off it, and {:.2g} mm if "
      "the data are moved back by ({:.2g}, {:.2g}, {:.2g}) mm and turned back by {:.2g} degrees about ({:.2g}, {:.2g}, "
      "{:.2g})",
      source, units.to_mm(found.before), units.to_mm(found.after), units.to_mm(by(0)), units.to_mm(by(1)),
      units.to_mm(by(2)), turned.norm() * 180 / std::numbers::pi, turned.normalized()(0), turned.normalized()(1),
      turned.normalized()(2));
}

std::vector<std::string> before_any_physics(const Comparison& comparison) {
  std::vector<std::string> all;
  if (!comparison.run.is_evidence())
    all.push_back(fmt::format(
        "NO EVIDENCE: this run was pulled toward the data (observer.gain {:g} 1/s), which hides what the model lacks",
        comparison.run.observer_gain));
  for (const SourceDiscrepancy& source : comparison.sources)
    if (source.registration && source.registration->stands_out())
      all.push_back(sentence_of(*source.registration, source.name, comparison.units));
  return all;
}

/// Of all that was measured.
std::vector<std::string> findings(const Comparison& comparison) {
  std::vector<std::string> all;
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
  for (const OtherDiscrepancy& other : comparison.others)
    for (std::string& sentence : sentences_of(other)) all.push_back(std::move(sentence));
  return all;
}

}  // namespace

std::vector<std::string> sentences_of(const Comparison& comparison) {
  std::vector<std::string> all = before_any_physics(comparison);
  for (std::string& finding : findings(comparison)) all.push_back(std::move(finding));
  return all;
}

namespace {

/// Of the source and the frames in which the model is off by most of their noise; none if it is nowhere.
std::optional<std::string> worst_failure(const Comparison& comparison) {
  std::optional<std::string> sentence;
  double most = 0;
  for (const SourceDiscrepancy& source : comparison.sources)
    for (const bool held_out : {false, true}) {
      const Judgement judgement = judge(source, held_out);
      const Failure* worst = worst_of(judgement);
      if (worst == nullptr || worst->size() / source.noise.deviation <= most) continue;
      most = worst->size() / source.noise.deviation;
      sentence = sentences_of(judgement, source, held_out, comparison.units).front();
    }
  return sentence;
}

}  // namespace

std::vector<std::string> first_look_of(const Comparison& comparison) {
  std::vector<std::string> all = before_any_physics(comparison);
  std::vector<std::string> found = findings(comparison);
  if (std::optional<std::string> worst = worst_failure(comparison))
    all.push_back(std::move(*worst));
  else if (!found.empty())
    all.push_back(std::move(found.front()));
  return all;
}

}  // namespace tether
