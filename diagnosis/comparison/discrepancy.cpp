#include "diagnosis/comparison/discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tether {
namespace {

/// Samples by contour and region. The places of the groups of a source are the same in all moments.
class Grouped {
 public:
  Grouped(const LumenSeries& data, const ErrorRegions& regions) : regions_(&regions) {
    const int series = data.series_names().size() > 1 ? static_cast<int>(data.series_names().size()) : 0;
    for (int s = -1; s < series; ++s)
      for (int r = -1; r < static_cast<int>(regions.names.size()); ++r) groups_[{s, r}];
  }
  void add(const std::vector<Sample>& model, const std::vector<Sample>& apparent) {
    for (auto& [place, both] : groups_) {
      for (const Sample& sample : model)
        if (holds(place, sample)) both.model.add(sample);
      for (const Sample& sample : apparent)
        if (holds(place, sample)) both.apparent.add(sample);
    }
  }
  std::vector<Group> groups() const {
    std::vector<Group> result;
    for (const auto& [place, both] : groups_)
      result.push_back({place.first, place.second, both.model.statistics(), both.apparent.statistics()});
    return result;
  }

 private:
  using Place = std::pair<int, int>;
  struct Both {
    Distances model, apparent;
  };
  bool holds(const Place& place, const Sample& sample) const {
    return (place.first < 0 || place.first == sample.series) &&
           (place.second < 0 || place.second == regions_->of(sample.region));
  }

  const ErrorRegions* regions_;
  std::map<Place, Both> groups_;
};

/// Contours are independent of each other: their effective numbers add up.
void set_effective_numbers(std::vector<Group>& groups, int dimension, double correlation) {
  std::map<int, double> of_contours;
  for (Group& group : groups) {
    group.effective = effective_number(group.model.extent, dimension, correlation, group.model.used());
    if (group.series >= 0) of_contours[group.region] += group.effective;
  }
  for (Group& group : groups)
    if (group.series < 0 && of_contours.count(group.region) > 0) group.effective = of_contours[group.region];
}

/// Frames within a correlation time are alike: over all moments of a kind a group has the mean number of one of them,
/// times the effective number of moments (D.2).
void set_pooled_numbers(std::vector<Group>& pooled, const std::vector<Moment>& moments, bool held_out,
                        double correlation_time) {
  if (correlation_time <= 0) return;
  for (std::size_t g = 0; g < pooled.size(); ++g) {
    std::vector<double> times;
    double sum = 0;
    for (const Moment& moment : moments)
      if (moment.held_out == held_out && moment.groups[g].model.used() > 0) {
        times.push_back(moment.time);
        sum += moment.groups[g].effective;
      }
    if (times.empty()) continue;
    const auto count = static_cast<int>(times.size());
    pooled[g].effective = sum / count * effective_number(times.back() - times.front(), 1, correlation_time, count);
  }
}

/// Frames of equal time and kind become one moment; those that the run does not reach are returned apart.
std::vector<Moment> moments_of(const LumenSeries& data, const RunMotion& run, std::vector<Frame>& outside) {
  const SourceSettings& settings = data.settings();
  std::vector<Moment> moments;
  for (const Frame& frame : data.frames()) {
    const auto time = time_in_run(frame.time, settings.period, run.start, run.end, settings.time_tolerance);
    if (!time) {
      outside.push_back(frame);
      continue;
    }
    const auto same = std::find_if(moments.begin(), moments.end(), [&](const Moment& moment) {
      return moment.held_out == frame.held_out && std::abs(moment.time - *time) <= 1e-9 * (run.end - run.start);
    });
    if (same != moments.end())
      same->frames.push_back(frame);
    else
      moments.push_back({*time, frame.time, frame.held_out, {frame}, {}});
  }
  std::stable_sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) { return a.time < b.time; });
  return moments;
}

}  // namespace

SourceDiscrepancy compare(const LumenSeries& data, const ErrorRegions& regions, const RunMotion& run) {
  SourceDiscrepancy result;
  result.name = data.settings().name;
  result.kind = data.kind().name;
  result.dimension = data.sample_dimension();
  result.noise = data.settings().noise;
  result.series = data.series_names();
  result.regions = regions.names;
  result.notes = told(data.notes());
  result.moments = moments_of(data, run, result.outside);
  Grouped training(data, regions), held_out = training;
  for (Moment& moment : result.moments) {
    const Points lumen = run.positions(moment.time);
    Grouped now(data, regions);
    std::vector<Sample> against_image;
    for (const Frame& frame : moment.frames) {
      const std::vector<Sample> model = data.observe(lumen, frame), apparent = data.observe(run.imaged, frame);
      against_image.insert(against_image.end(), apparent.begin(), apparent.end());
      for (Grouped* grouped : {&now, moment.held_out ? &held_out : &training}) grouped->add(model, apparent);
    }
    moment.groups = now.groups();
    set_effective_numbers(moment.groups, result.dimension, result.noise.correlation_length);
    const auto found = registration_of(against_image, result.noise.deviation, group_of_region(moment, -1)->effective);
    if (found && (!result.registration || found->before < result.registration->before)) result.registration = found;
  }
  result.training = training.groups();
  result.held_out = held_out.groups();
  for (auto* groups : {&result.training, &result.held_out})
    set_pooled_numbers(*groups, result.moments, groups == &result.held_out, result.noise.correlation_time);
  return result;
}

std::size_t SourceDiscrepancy::frames() const {
  std::size_t count = outside.size();
  for (const Moment& moment : moments) count += moment.frames.size();
  return count;
}

const Group* group_of_region(const Moment& moment, int region) {
  const auto found = std::find_if(moment.groups.begin(), moment.groups.end(),
                                  [&](const Group& g) { return g.series < 0 && g.region == region; });
  return found == moment.groups.end() ? nullptr : &*found;
}

std::string region_name(const SourceDiscrepancy& source, int region) {
  return region >= 0 ? source.regions[static_cast<std::size_t>(region)] : source.regions.empty() ? "wall" : "all";
}

double significance(const Group& group, const Noise& noise) {
  return group.model.mean * std::sqrt(group.effective) / noise.deviation;  // (D.3)
}

}  // namespace tether
