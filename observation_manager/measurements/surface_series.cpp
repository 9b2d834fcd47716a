#include "observation_manager/measurements/surface_series.hpp"

#include <algorithm>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"

namespace tether {
namespace {

std::vector<double> times_of(const std::vector<SurfaceFrame>& frames) {
  std::vector<double> times;
  for (const SurfaceFrame& frame : frames) times.push_back(frame.time);
  return times;
}

void exclude(Sample& sample, Exclusion why) {
  sample.excluded = why;
  sample.weight = 0;
}

}  // namespace

SurfaceSeries::SurfaceSeries(SourceSettings settings, std::vector<SurfaceFrame> frames,
                             const std::vector<bool>& held_out, const LumenSurface& lumen, std::vector<Note> notes)
    : settings_(std::move(settings)),
      times_(times_of(frames), settings_.period, settings_.time_tolerance, held_out),
      frames_(std::move(frames)),
      areas_(nodal_areas(lumen)),
      notes_(std::move(notes)) {}

Sample SurfaceSeries::sample_of_node(Eigen::Index node, const Vec3& x) const {
  const auto i = static_cast<std::size_t>(node);
  Sample sample;
  sample.nodes.fill(static_cast<int>(node));
  sample.position = x;
  sample.weight = areas_[node];
  sample.region = settings_.region[i];
  if (settings_.of_node[i] != Exclusion::none) exclude(sample, settings_.of_node[i]);
  return sample;
}

std::vector<Sample> SurfaceSeries::against(const Points& x, std::size_t frame) const {
  TETHER_ASSERT(x.cols() == areas_.size(), "{} points for a lumen of {}", x.cols(), areas_.size());
  const std::vector<bool>& flawed = frames_[frame].flawed;
  FrameTree& kept = tree(frame);
  const std::vector<Closest> found = kept.surface.closest(x, kept.near);
  std::vector<Sample> samples;
  samples.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    Sample& sample = samples.emplace_back(sample_of_node(node, x.col(node)));
    sample.distance = found[i].distance + settings_.outward;
    sample.normal = found[i].normal;
    if (sample.excluded != Exclusion::none) continue;
    if (found[i].on_rim)
      exclude(sample, Exclusion::rim);
    else if (std::abs(sample.distance) > settings_.trust_distance)
      exclude(sample, Exclusion::too_far);
    else if (!flawed.empty() && flawed[static_cast<std::size_t>(found[i].triangle)])
      exclude(sample, Exclusion::flawed);
  }
  return samples;
}

std::vector<Sample> SurfaceSeries::observe(const Points& x, double time) const {
  const std::vector<FrameShare> shares = times_.at(time);
  std::vector<Sample> samples;
  if (shares.empty()) {
    for (Eigen::Index node = 0; node < x.cols(); ++node)
      exclude(samples.emplace_back(sample_of_node(node, x.col(node))), Exclusion::no_frame);
    return samples;
  }
  std::erase_if(trees_, [&](const auto& kept) {
    return std::none_of(shares.begin(), shares.end(), [&](const FrameShare& s) { return s.frame == kept.first; });
  });
  std::vector<std::vector<Sample>> of_frames;
  for (const FrameShare& share : shares) of_frames.push_back(against(x, share.frame));
  std::vector<Sample> of_node(shares.size());
  for (std::size_t node = 0; node < of_frames.front().size(); ++node) {
    for (std::size_t i = 0; i < shares.size(); ++i) of_node[i] = of_frames[i][node];
    samples.push_back(between(of_node, shares));
  }
  return samples;
}

std::vector<Sample> SurfaceSeries::observe(const Points& x, const Frame& frame) const {
  std::erase_if(trees_, [&](const auto& kept) { return kept.first != frame.number; });
  return against(x, frame.number);
}

std::vector<Frame> SurfaceSeries::frames() const {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < frames_.size(); ++i)
    frames.push_back({0, i, frames_[i].time, times_.held_out(i), frames_[i].label});
  return frames;
}

std::uint64_t SurfaceSeries::content() const {
  std::uint64_t hash = hash_values(times_.times(), 0);
  if (settings_.outward != 0) hash = hash_bytes(&settings_.outward, sizeof settings_.outward, hash);
  for (const SurfaceFrame& frame : frames_)
    hash = hash_values(frame.surface.triangles, hash_values(frame.surface.points, hash));
  return hash;
}

SurfaceSeries::FrameTree& SurfaceSeries::tree(std::size_t frame) const {
  const auto found = trees_.find(frame);
  if (found != trees_.end()) return found->second;
  return trees_.emplace(frame, FrameTree{SignedSurface(frames_[frame].surface), {}}).first->second;
}

}  // namespace tether
