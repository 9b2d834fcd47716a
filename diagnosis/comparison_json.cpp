#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "diagnosis/comparison.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

Json distances_json(const Statistics& s, double unit) {
  return {{"l2", s.rms / unit}, {"linf", s.largest / unit}, {"mean", s.mean / unit}, {"p95", s.p95 / unit}};
}

Json statistics_json(const Statistics& s, const Noise& noise) {
  Json json{{"samples", s.used()}, {"excluded", Json::object()}, {"extent", s.extent}};
  for (std::size_t why = 1; why < exclusion_count; ++why)
    if (s.counts[why] > 0) json["excluded"][std::string(meaning_of(static_cast<Exclusion>(why)))] = s.counts[why];
  if (s.used() == 0) return json;
  json.update(distances_json(s, 1));
  json["l2_unnormalised"] = s.unnormalised;
  if (noise.deviation > 0) json["in_noise"] = distances_json(s, noise.deviation);
  return json;
}

Json group_json(const Group& group, const SourceDiscrepancy& source) {
  Json json{{"series", nullptr}, {"region", nullptr}};
  if (group.series >= 0) json["series"] = source.series[static_cast<std::size_t>(group.series)];
  if (group.region >= 0) json["region"] = source.regions[static_cast<std::size_t>(group.region)];
  json.update(statistics_json(group.model, source.noise));
  if (group.effective > 0) {
    json["effective_observations"] = group.effective;
    if (source.noise.deviation > 0) json["z"] = significance(group, source.noise);
  }
  json["apparent"] = statistics_json(group.apparent, source.noise);
  return json;
}

Json groups_json(const std::vector<Group>& groups, const SourceDiscrepancy& source) {
  Json json = Json::array();
  for (const Group& group : groups)
    if (group.model.used() > 0 || group.apparent.used() > 0) json.push_back(group_json(group, source));
  return json;
}

/// A frame without a time holds always: null.
Json time_json(double time) {
  return std::isnan(time) ? Json(nullptr) : Json(time);
}

Json frames_json(const std::vector<Frame>& frames, const SourceDiscrepancy& source) {
  Json json = Json::array();
  for (const Frame& frame : frames)
    json.push_back({{"series", source.series[static_cast<std::size_t>(frame.series)]},
                    {"frame", frame.label},
                    {"time", time_json(frame.time)}});
  return json;
}

Json moment_json(const Moment& moment, const SourceDiscrepancy& source) {
  return {{"time", moment.time},
          {"held_out", moment.held_out},
          {"frames", frames_json(moment.frames, source)},
          {"groups", groups_json(moment.groups, source)}};
}

Json failure_json(const Failure& failure, const SourceDiscrepancy& source, const UnitSystem& units) {
  return {{"region", region_name(source, failure.region)},
          {"first", failure.first},
          {"last", failure.last},
          {"worst", failure.worst},
          {"shifted", failure.shifted},
          {"mean", failure.mean},
          {"l2", failure.rms},
          {"z", failure.z},
          {"sentence", sentence_of(failure, source, units)}};
}

Json verdict_json(const SourceDiscrepancy& source, bool held_out, const UnitSystem& units) {
  const Verdict verdict = judge(source, held_out);
  Json json{{"tests", verdict.tests}, {"limit", verdict.limit}, {"failures", Json::array()}, {"visible_offset", {}}};
  for (const Failure& failure : verdict.failures) json["failures"].push_back(failure_json(failure, source, units));
  for (const auto& [region, offset] : verdict.visible) json["visible_offset"][region_name(source, region)] = offset;
  return json;
}

Json vector_json(const Vec3& v) {
  return {v(0), v(1), v(2)};
}

Json registration_json(const SourceDiscrepancy& source) {
  if (!source.registration) return nullptr;
  const Registration& r = *source.registration;
  return {{"displacement", vector_json(r.motion.displacement)},
          {"rotation", vector_json(r.motion.rotation)},
          {"centre", vector_json(r.motion.centre)},
          {"before", r.before},
          {"after", r.after},
          {"stands_out", r.stands_out()}};
}

Json source_json(const SourceDiscrepancy& source, const UnitSystem& units) {
  Json json{{"name", source.name},
            {"kind", source.dimension == 2 ? "surfaces" : "contours"},
            {"series", source.series},
            {"regions", source.regions},
            {"noise",
             {{"deviation", source.noise.deviation},
              {"correlation_length", source.noise.correlation_length},
              {"correlation_time", source.noise.correlation_time}}},
            {"notes", source.notes},
            {"registration", registration_json(source)},
            {"frames", source.frames()},
            {"frames_outside_the_run", frames_json(source.outside, source)}};
  for (const auto& [name, held_out] : {std::pair{"training", false}, {"held_out", true}})
    json[name] = {{"verdict", verdict_json(source, held_out, units)},
                  {"all_frames", groups_json(held_out ? source.held_out : source.training, source)}};
  json["moments"] = Json::array();
  for (const Moment& moment : source.moments) json["moments"].push_back(moment_json(moment, source));
  return json;
}

Json trace_json(const TraceDiscrepancy& trace) {
  Json json{{"name", trace.name},         {"observable", trace.observable}, {"unit", trace.unit},
            {"held_out", trace.held_out}, {"values", trace.times.size()},   {"values_outside_the_run", trace.outside}};
  if (trace.times.empty()) return json;
  json.update(Json{{"l2", trace.rms}, {"linf", trace.largest}, {"bias", trace.bias}});
  json["effective_observations"] = trace.effective;
  if (const double unit = trace.noise.deviation; unit > 0)
    json["in_noise"] = {{"l2", trace.rms / unit}, {"linf", trace.largest / unit}, {"bias", trace.bias / unit}};
  if (trace.z()) json["z"] = *trace.z();
  return json;
}

Json statistics_json(const VelocityStatistics& s, const VelocityDiscrepancy& velocity) {
  Json json{{"points", s.used}};
  if (s.used == 0) return json;
  json.update(Json{{"l2", s.rms}, {"linf", s.largest}, {"l2_measured", s.measured}});
  if (velocity.components == 1) json["bias"] = s.bias;
  if (const double unit = velocity.noise.deviation; unit > 0)
    json["in_noise"] = {{"l2", s.rms / unit}, {"linf", s.largest / unit}};
  return json;
}

Json moment_json(const VelocityMoment& moment, const VelocityDiscrepancy& velocity) {
  Json json{{"time", moment.time}, {"data_time", moment.data_time}, {"held_out", moment.held_out}};
  json.update(statistics_json(moment.found, velocity));
  json["points_outside_the_lumen"] = moment.missed;
  json["effective_points"] = moment.found.effective;
  if (const auto z = velocity.z(moment)) json["z"] = *z;
  return json;
}

Json velocity_json(const VelocityDiscrepancy& velocity) {
  Json json{{"name", velocity.name},
            {"unit", velocity.unit},
            {"components", velocity.components},
            {"points", velocity.points},
            {"frames_outside_the_run", velocity.outside},
            {"training", statistics_json(velocity.training, velocity)},
            {"held_out", statistics_json(velocity.held_out, velocity)},
            {"moments", Json::array()}};
  for (const VelocityMoment& moment : velocity.moments) json["moments"].push_back(moment_json(moment, velocity));
  return json;
}

}  // namespace

void write_json(const std::filesystem::path& path, const Comparison& comparison) {
  const ComparedRun& run = comparison.run;
  Json json{{"case", run.case_name}, {"title", run.title}};
  json["run"] = {{"folder", run.folder},
                 {"steps", run.steps},
                 {"start", run.start},
                 {"end", run.end},
                 {"observer_gain", run.observer_gain},
                 {"is_evidence", run.is_evidence()}};
  json["units"] = {
      {"system", comparison.units.name()}, {"length", comparison.units.symbol(dimension::length)}, {"time", "s"}};
  json["sentences"] = sentences_of(comparison);
  json["sources"] = Json::array();
  for (const SourceDiscrepancy& source : comparison.sources)
    json["sources"].push_back(source_json(source, comparison.units));
  json["traces"] = Json::array();
  for (const TraceDiscrepancy& trace : comparison.traces) json["traces"].push_back(trace_json(trace));
  json["velocities"] = Json::array();
  for (const VelocityDiscrepancy& velocity : comparison.velocities)
    json["velocities"].push_back(velocity_json(velocity));
  std::ofstream file(path);
  file << json.dump(1) << std::endl;
  if (!file) throw run_error("{} cannot be written", path.string());
}

}  // namespace tether
