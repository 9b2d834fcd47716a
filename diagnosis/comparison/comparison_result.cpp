#include "diagnosis/comparison/comparison_result.hpp"

#include <cmath>

namespace tether {
namespace {

std::optional<double> if_known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

StatisticsTold told(const Statistics& s, const Noise& noise) {
  StatisticsTold told;
  told.samples = s.used();
  told.extent = s.extent;
  for (std::size_t why = 1; why < exclusion_count; ++why)
    if (s.counts[why] > 0) told.excluded[std::string(meaning_of(static_cast<Exclusion>(why)))] = s.counts[why];
  if (s.used() == 0) return told;
  told.rms = s.rms;
  told.largest = s.largest;
  told.mean = s.mean;
  told.p95 = s.p95;
  told.unnormalised = s.unnormalised;
  if (const double unit = noise.deviation; unit > 0)
    told.in_noise = DistancesTold{s.rms / unit, s.largest / unit, s.mean / unit, s.p95 / unit};
  return told;
}

GroupTold told(const Group& group, const SourceDiscrepancy& source) {
  GroupTold result;
  static_cast<StatisticsTold&>(result) = told(group.model, source.noise);
  if (group.series >= 0) result.series = source.series[static_cast<std::size_t>(group.series)];
  if (group.region >= 0) result.region = source.regions[static_cast<std::size_t>(group.region)];
  if (group.effective > 0) result.effective_observations = group.effective;
  if (group.effective > 0 && source.noise.deviation > 0) result.z = significance(group, source.noise);
  result.apparent = told(group.apparent, source.noise);
  return result;
}

std::vector<GroupTold> told(const std::vector<Group>& groups, const SourceDiscrepancy& source) {
  std::vector<GroupTold> all;
  for (const Group& group : groups)
    if (group.model.used() > 0 || group.apparent.used() > 0) all.push_back(told(group, source));
  return all;
}

std::vector<FrameTold> told(const std::vector<Frame>& frames, const SourceDiscrepancy& source) {
  std::vector<FrameTold> all;
  for (const Frame& frame : frames)
    all.push_back({source.series[static_cast<std::size_t>(frame.series)], frame.label, if_known(frame.time)});
  return all;
}

JudgementTold told(const Judgement& judgement, const SourceDiscrepancy& source, const UnitSystem& units) {
  JudgementTold result{judgement.tests, judgement.limit, {}, {}};
  for (const Failure& f : judgement.failures)
    result.failures.push_back({region_name(source, f.region), f.first, f.last, f.worst, f.shifted, f.mean, f.rms, f.z,
                               sentence_of(f, source, units)});
  for (const auto& [region, offset] : judgement.visible) result.visible_offset[region_name(source, region)] = offset;
  return result;
}

std::optional<RegistrationTold> told(const std::optional<Registration>& found) {
  if (!found) return std::nullopt;
  const auto& motion = found->motion;
  return RegistrationTold{motion.displacement, motion.rotation, motion.centre,
                          found->before,       found->after,    found->stands_out()};
}

SourceCompared told(const SourceDiscrepancy& source, const UnitSystem& units) {
  SourceCompared result;
  result.name = source.name;
  result.kind = source.kind;
  result.series = source.series;
  result.regions = source.regions;
  result.noise = {source.noise.deviation, source.noise.correlation_length, source.noise.correlation_time};
  result.notes = source.notes;
  result.registration = told(source.registration);
  result.frames = static_cast<int>(source.frames());
  result.frames_outside_the_run = told(source.outside, source);
  result.training = {told(judge(source, false), source, units), told(source.training, source)};
  result.held_out = {told(judge(source, true), source, units), told(source.held_out, source)};
  for (const Moment& moment : source.moments)
    result.moments.push_back({moment.time, moment.held_out, told(moment.frames, source), told(moment.groups, source)});
  return result;
}

TraceCompared told(const TraceDiscrepancy& trace) {
  TraceCompared result;
  result.name = trace.name;
  result.observable = trace.observable;
  result.unit = trace.unit;
  result.held_out = trace.held_out;
  result.values = static_cast<int>(trace.times.size());
  result.values_outside_the_run = trace.outside;
  if (trace.times.empty()) return result;
  result.rms = trace.rms;
  result.largest = trace.largest;
  result.bias = trace.bias;
  result.effective_observations = trace.effective;
  if (const double unit = trace.noise.deviation; unit > 0)
    result.in_noise = TraceInNoise{trace.rms / unit, trace.largest / unit, trace.bias / unit};
  result.z = trace.z();
  return result;
}

VelocityStatisticsTold told(const VelocityStatistics& s, const VelocityDiscrepancy& velocity) {
  VelocityStatisticsTold result;
  result.points = s.used;
  if (s.used == 0) return result;
  result.rms = s.rms;
  result.largest = s.largest;
  result.measured = s.measured;
  if (velocity.components == 1) result.bias = s.bias;
  if (const double unit = velocity.noise.deviation; unit > 0)
    result.in_noise = VelocityInNoise{s.rms / unit, s.largest / unit};
  return result;
}

VelocityMomentTold told(const VelocityMoment& moment, const VelocityDiscrepancy& velocity) {
  VelocityMomentTold result;
  static_cast<VelocityStatisticsTold&>(result) = told(moment.found, velocity);
  result.time = moment.time;
  result.data_time = moment.data_time;
  result.held_out = moment.held_out;
  result.points_outside_the_lumen = moment.missed;
  result.effective_points = moment.found.effective;
  result.z = velocity.z(moment);
  return result;
}

VelocityCompared told(const VelocityDiscrepancy& velocity) {
  VelocityCompared result{velocity.name,
                          velocity.unit,
                          velocity.components,
                          velocity.points,
                          velocity.outside,
                          told(velocity.training, velocity),
                          told(velocity.held_out, velocity),
                          {}};
  for (const VelocityMoment& moment : velocity.moments) result.moments.push_back(told(moment, velocity));
  return result;
}

OtherStatisticsTold told(const OtherStatistics& s, const Noise& noise) {
  OtherStatisticsTold result;
  result.values = s.used;
  if (s.used == 0) return result;
  result.rms = s.rms;
  result.largest = s.largest;
  result.bias = s.bias;
  if (const double unit = noise.deviation; unit > 0)
    result.in_noise = TraceInNoise{s.rms / unit, s.largest / unit, s.bias / unit};
  return result;
}

OtherCompared told(const OtherDiscrepancy& other) {
  return {other.name, other.kind, other.unit, told(other.training, other.noise), told(other.held_out, other.noise)};
}

}  // namespace

ComparisonResult result_of(const Comparison& comparison) {
  const ComparedRun& run = comparison.run;
  ComparisonResult result;
  result.case_name = run.case_name;
  result.title = run.title;
  result.run = {run.folder, run.steps, run.start, run.end, run.observer_gain, run.is_evidence()};
  result.units = {comparison.units.name(), comparison.units.symbol(dimension::length), "s"};
  result.sentences = sentences_of(comparison);
  result.first_look = first_look_of(comparison);
  for (const SourceDiscrepancy& source : comparison.sources) result.sources.push_back(told(source, comparison.units));
  for (const TraceDiscrepancy& trace : comparison.traces) result.traces.push_back(told(trace));
  for (const VelocityDiscrepancy& velocity : comparison.velocities) result.velocities.push_back(told(velocity));
  for (const OtherDiscrepancy& other : comparison.others) result.others.push_back(told(other));
  return result;
}

}  // namespace tether
