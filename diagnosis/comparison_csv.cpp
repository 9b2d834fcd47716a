#include <fmt/format.h>

#include <fstream>

#include "common/base/error.hpp"
#include "diagnosis/comparison.hpp"

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

}  // namespace

void write_csv(const std::filesystem::path& path, const Comparison& comparison) {
  std::ofstream file(path);
  file << heading(comparison.units);
  for (const SourceDiscrepancy& source : comparison.sources)
    for (const Moment& moment : source.moments)
      for (const Group& group : moment.groups)
        if (group.model.used() > 0) file << row(group, moment, source);
  file.flush();
  if (!file) throw run_error("{} cannot be written", path.string());
}

}  // namespace tether
