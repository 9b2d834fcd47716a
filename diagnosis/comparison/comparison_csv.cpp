#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "diagnosis/comparison/comparison.hpp"

namespace tether {
namespace {

std::string heading(const UnitSystem& units) {
  const std::string length = units.symbol(dimension::length);
  std::string text = "source,series,time [s],held_out,region,samples,excluded,extent,l2_unnormalised";
  for (const char* name :
       {"l2", "linf", "mean", "p95", "apparent_l2", "apparent_linf", "apparent_mean", "apparent_p95"})
    text += fmt::format(",{} [{}]", name, length);
  return text + ",effective_observations,noise [" + length + "],z\n";
}

int excluded(const Statistics& s) {
  int count = 0;
  for (std::size_t why = 1; why < exclusion_count; ++why) count += s.counts[why];
  return count;
}

/// A name with a comma in quotes.
std::string cell(const std::string& name) {
  return name.find(',') == std::string::npos ? name : '"' + name + '"';
}

std::string row(const Group& group, const Moment& moment, const SourceDiscrepancy& source) {
  std::string text =
      fmt::format("{},{},{:.9g},{},{},{},{},{:.9g},{:.9g}", source.name,
                  group.series < 0 ? "all" : cell(source.series[static_cast<std::size_t>(group.series)]), moment.time,
                  moment.held_out ? 1 : 0, group.region < 0 ? "all" : region_name(source, group.region),
                  group.model.used(), excluded(group.model), group.model.extent, group.model.unnormalised);
  for (const Statistics* s : {&group.model, &group.apparent})
    text += fmt::format(",{:.9g},{:.9g},{:.9g},{:.9g}", s->rms, s->largest, s->mean, s->p95);
  const double deviation = source.noise.deviation;
  text += fmt::format(",{:.9g},{:.9g}", group.effective, deviation);
  return text + (deviation > 0 ? fmt::format(",{:.9g}\n", significance(group, source.noise)) : ",\n");
}

/// What a row of comparison_blood.csv is about.
struct BloodSource {
  std::string name, kind, unit;
  double deviation = 0;
};

struct BloodValues {
  std::optional<double> time;  ///< none: over all
  bool held_out = false;
  int used = 0, excluded = 0;
  double rms = 0, largest = 0;
  std::optional<double> measured, bias, effective, z;
};

std::string blood_row(const BloodSource& source, const BloodValues& v) {
  const auto optional = [](const std::optional<double>& x) { return x ? fmt::format("{:.9g}", *x) : std::string(); };
  return fmt::format("{},{},{},{},{},{},{},{:.9g},{:.9g},{},{},{},{:.9g},{}\n", cell(source.name), source.kind,
                     source.unit, optional(v.time), v.held_out ? 1 : 0, v.used, v.excluded, v.rms, v.largest,
                     optional(v.bias), optional(v.measured), optional(v.effective), source.deviation, optional(v.z));
}

double rms_of(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v / static_cast<double>(values.size());
  return std::sqrt(squares);
}

std::string rows_of(const TraceDiscrepancy& trace) {
  const BloodSource source{trace.name, "trace", trace.unit, trace.noise.deviation};
  std::string rows = blood_row(source, {{},
                                        trace.held_out,
                                        static_cast<int>(trace.times.size()),
                                        trace.outside,
                                        trace.rms,
                                        trace.largest,
                                        rms_of(trace.measured),
                                        trace.bias,
                                        trace.effective,
                                        trace.z()});
  for (std::size_t i = 0; i < trace.times.size(); ++i) {
    const double difference = trace.measured[i] - trace.model[i], size = std::abs(difference);
    rows += blood_row(
        source, {trace.times[i], trace.held_out, 1, 0, size, size, std::abs(trace.measured[i]), difference, {}, {}});
  }
  return rows;
}

std::string rows_of(const VelocityDiscrepancy& velocity) {
  const BloodSource source{velocity.name, "velocities", velocity.unit, velocity.noise.deviation};
  const auto values = [&](const VelocityStatistics& s, bool held_out) {
    BloodValues v{{}, held_out, s.used, 0, s.rms, s.largest, s.measured, {}, {}, {}};
    if (velocity.components == 1 && s.used > 0) v.bias = s.bias;
    return v;
  };
  std::string rows;
  for (const bool held_out : {false, true})
    if (const auto& all = held_out ? velocity.held_out : velocity.training; all.used > 0)
      rows += blood_row(source, values(all, held_out));
  for (const VelocityMoment& moment : velocity.moments) {
    BloodValues v = values(moment.found, moment.held_out);
    v.time = moment.time, v.excluded = moment.missed, v.effective = moment.found.effective, v.z = velocity.z(moment);
    rows += blood_row(source, v);
  }
  return rows;
}

std::string rows_of(const OtherDiscrepancy& other) {
  const BloodSource source{other.name, other.kind, other.unit, other.noise.deviation};
  std::string rows;
  for (const bool held_out : {false, true})
    if (const OtherStatistics& s = held_out ? other.held_out : other.training; s.used > 0)
      rows += blood_row(source, {{}, held_out, s.used, 0, s.rms, s.largest, {}, s.bias, {}, {}});
  return rows;
}

}  // namespace

void write_blood_csv(const std::filesystem::path& path, const Comparison& comparison) {
  std::ofstream file(path);
  file
      << "source,kind,unit,time [s],held_out,values,excluded,l2,linf,bias,l2_measured,effective_observations,noise,z\n";
  for (const TraceDiscrepancy& trace : comparison.traces) file << rows_of(trace);
  for (const VelocityDiscrepancy& velocity : comparison.velocities) file << rows_of(velocity);
  for (const OtherDiscrepancy& other : comparison.others) file << rows_of(other);
  file.flush();
  if (!file) throw write_error(path);
}

void write_csv(const std::filesystem::path& path, const Comparison& comparison) {
  std::ofstream file(path);
  file << heading(comparison.units);
  for (const SourceDiscrepancy& source : comparison.sources)
    for (const Moment& moment : source.moments)
      for (const Group& group : moment.groups)
        if (group.model.used() > 0) file << row(group, moment, source);
  file.flush();
  if (!file) throw write_error(path);
}

}  // namespace tether
