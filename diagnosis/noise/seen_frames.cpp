#include "diagnosis/noise/seen_frames.hpp"

#include <algorithm>
#include <map>

namespace tether {
namespace {

std::size_t count(const SeenFrame& frame) {
  return static_cast<std::size_t>(std::count_if(frame.samples.begin(), frame.samples.end(),
                                                [](const Sample& s) { return s.excluded == Exclusion::none; }));
}

}  // namespace

std::vector<SeenSeries> seen_series(const LumenSeries& data, const RunMotion& run, const LumenAt& lumen) {
  std::map<int, std::vector<SeenFrame>> by_series;
  for (const Frame& frame : data.frames())
    if (const auto time =
            time_in_run(frame.time, data.settings().period, run.start, run.end, data.settings().time_tolerance))
      by_series[frame.series].push_back({frame, *time, data.observe(lumen(*time), frame)});
  std::vector<SeenSeries> all;
  for (auto& [series, frames] : by_series) {
    std::stable_sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    all.push_back({series, std::move(frames)});
  }
  return all;
}

std::vector<std::size_t> common_samples(std::vector<SeenFrame>& frames) {
  std::size_t fullest = 0;
  for (const SeenFrame& frame : frames) fullest = std::max(fullest, count(frame));
  std::erase_if(frames, [&](const SeenFrame& frame) { return 2 * count(frame) < fullest; });
  std::vector<std::size_t> common;
  for (std::size_t i = 0; !frames.empty() && i < frames.front().samples.size(); ++i)
    if (std::all_of(frames.begin(), frames.end(), [i](const SeenFrame& frame) {
          return i < frame.samples.size() && frame.samples[i].excluded == Exclusion::none;
        }))
      common.push_back(i);
  return common;
}

MeanPlaces mean_places(const std::vector<SeenFrame>& frames, const std::vector<std::size_t>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  MeanPlaces mean{Points::Zero(3, n), Points::Zero(3, n)};
  for (const SeenFrame& frame : frames)
    for (Eigen::Index i = 0; i < n; ++i) {
      const Sample& sample = frame.samples[samples[static_cast<std::size_t>(i)]];
      mean.places.col(i) += sample.position / static_cast<double>(frames.size());
      mean.normals.col(i) += sample.normal;
    }
  mean.normals.colwise().normalize();
  return mean;
}

VectorXd distances(const SeenFrame& frame, const std::vector<std::size_t>& samples) {
  VectorXd all(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i)
    all(static_cast<Eigen::Index>(i)) = frame.samples[samples[i]].distance;
  return all;
}

VectorXd along_normals(const Points& nodal, const SeenFrame& frame, const std::vector<std::size_t>& samples) {
  VectorXd all(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = frame.samples[samples[i]];
    Vec3 vector = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      vector += sample.shares[static_cast<Eigen::Index>(k)] * nodal.col(sample.nodes[k]);
    all(static_cast<Eigen::Index>(i)) = vector.dot(sample.normal);
  }
  return all;
}

}  // namespace tether
