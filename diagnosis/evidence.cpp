#include "diagnosis/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "diagnosis/curvature.hpp"

namespace tether {
namespace {

/// Frames or values that far apart count as tanh(apart/(2 tau)) independent ones. (K.5)
double share_of(double apart, double correlation_time) {
  return correlation_time > 0 && apart > 0 ? std::tanh(apart / (2 * correlation_time)) : 1;
}

/// Mean distance in time of the frames of one contour or surface.
double spacing(const std::vector<Frame>& frames, int series, double period) {
  std::vector<double> times;
  for (const Frame& frame : frames)
    if (frame.series == series) times.push_back(frame.time);
  if (times.size() < 2) return infinite;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return period > 0 ? period / static_cast<double>(times.size())
                    : (*last - *first) / static_cast<double>(times.size() - 1);
}

/// The part of the wall that a sample belongs to: a cube of four correlation lengths, within a region.
std::array<int, 4> patch_of(const Sample& sample, const Noise& noise) {
  std::array<int, 4> patch{sample.region};
  for (Eigen::Index i = 0; i < 3; ++i)
    patch[static_cast<std::size_t>(i) + 1] =
        static_cast<int>(std::floor(sample.position(i) / (4 * noise.correlation_length)));
  return patch;
}

double independent_part(const Noise& noise, int dimension, double observed) {
  const double l = noise.correlation_length;
  const double part = dimension == 2 ? 2 * std::numbers::pi * l * l : 2 * l;
  return observed > 0 ? std::min(part, observed) : part;
}

Eigen::Matrix3Xd as_columns(const std::vector<Vec3>& list) {
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = list[i];
  return all;
}

}  // namespace

Evidence::Evidence(const Observations& data, const LumenSurface& lumen, const FinishedMotion& base)
    : data_(data), lumen_(lumen), nodal_curvature_(tether::curvatures(lumen)), region_names_(lumen.region_names) {
  for (std::size_t s = 0; s < data.lumen.size(); ++s) add_frames(s, base);
  for (std::size_t t = 0; t < data.traces.size(); ++t) add_trace(t, base);
  normals_ = as_columns(normal_list_);
  places_ = as_columns(place_list_);
}

void Evidence::add_frames(std::size_t source, const FinishedMotion& base) {
  const LumenSeries& series = *data_.lumen[source];
  const SourceSettings& settings = series.settings();
  const std::vector<Frame> frames = series.frames();
  for (const Frame& frame : frames) {
    const auto time =
        time_in_run(frame.time, settings.period, base.motion.start, base.motion.end, settings.time_tolerance);
    if (!time) continue;
    const std::vector<Sample> samples = series.observe(base.motion.positions(*time), frame);
    double observed = 0;
    for (const Sample& sample : samples) observed += sample.weight;
    const double part = independent_part(settings.noise, series.sample_dimension(), observed),
                 share = share_of(spacing(frames, frame.series, settings.period), settings.noise.correlation_time);
    std::map<std::array<int, 4>, int> block_of;
    parts_.push_back(
        {source, frame, *time, static_cast<Eigen::Index>(residual_.size()), static_cast<Eigen::Index>(samples.size())});
    for (const Sample& sample : samples) {
      const auto [place, is_new] = block_of.try_emplace(patch_of(sample, settings.noise), blocks_);
      if (is_new) ++blocks_;
      residual_.push_back(sample.distance);
      held_out_.push_back(frame.held_out);
      independent_.push_back(sample.weight / part * share);
      precision_.push_back(independent_.back() / std::pow(settings.noise.deviation, 2));  // (K.5)
      region_.push_back(sample.region);
      block_.push_back(place->second);
      normal_list_.push_back(sample.normal);
      place_list_.push_back(sample.position);
      along_.push_back(along_vessel(sample));
      curvature_.push_back(sample.shares.dot(Vec3(nodal_curvature_(sample.nodes))));
    }
  }
}

double Evidence::along_vessel(const Sample& sample) const {
  double from = 0, to = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    from += sample.shares(static_cast<Eigen::Index>(k)) * lumen_.from_inlet(sample.nodes[k]);
    to += sample.shares(static_cast<Eigen::Index>(k)) * lumen_.from_outlet(sample.nodes[k]);
  }
  return from + to > 0 && std::isfinite(from + to) ? from / (from + to) : 0.5;
}

void Evidence::add_trace(std::size_t number, const FinishedMotion& base) {
  const Trace& trace = data_.traces[number];
  const TraceDiscrepancy seen = compare(trace, base.trace(trace.observable));
  if (seen.times.empty()) return;
  const double apart =
      seen.times.size() > 1 ? (seen.times.back() - seen.times.front()) / static_cast<double>(seen.times.size() - 1) : 0;
  const double share = share_of(apart, trace.noise.correlation_time);
  parts_.push_back({data_.lumen.size() + number,
                    {},
                    seen.times.front(),
                    static_cast<Eigen::Index>(residual_.size()),
                    static_cast<Eigen::Index>(seen.times.size())});
  const std::size_t frames = parts_.size() - 1;
  std::size_t last = parts_.size();
  for (std::size_t i = 0; i < seen.times.size(); ++i) {
    const std::size_t phase = closest_frame(seen.times[i], frames);
    if (phase != last) ++blocks_;
    last = phase;
    held_out_.push_back(trace.held_out || (phase < frames && parts_[phase].frame.held_out));
    residual_.push_back(seen.measured[i] - seen.model[i]);
    independent_.push_back(share);
    precision_.push_back(share / std::pow(trace.noise.deviation, 2));
    region_.push_back(-1);
    block_.push_back(blocks_);
    normal_list_.push_back(Vec3::Zero());
    place_list_.push_back(Vec3::Zero());
    along_.push_back(0);
    curvature_.push_back(0);
  }
  ++blocks_;
}

const Noise& Evidence::noise(const Part& part) const {
  return is_trace(part) ? data_.traces[part.source - data_.lumen.size()].noise
                        : data_.lumen[part.source]->settings().noise;
}

/// The number of the part whose moment is closest, of the first `frames`; `frames` if there are none.
std::size_t Evidence::closest_frame(double time, std::size_t frames) const {
  std::size_t best = frames;
  for (std::size_t k = 0; k < frames; ++k)
    if (!is_trace(parts_[k]) &&
        (best == frames || std::abs(parts_[k].time - time) < std::abs(parts_[best].time - time)))
      best = k;
  return best;
}

std::string Evidence::name_of(const Part& part) const {
  return is_trace(part) ? data_.traces[part.source - data_.lumen.size()].name
                        : data_.lumen[part.source]->settings().name;
}

double Evidence::distance_from(const Points& lumen, const Part& part) const {
  double squares = 0, weight = 0;
  for (const Sample& sample : data_.lumen[part.source]->observe(lumen, part.frame)) {
    squares += sample.weight * sample.distance * sample.distance;
    weight += sample.weight;
  }
  return weight > 0 ? std::sqrt(squares / weight) : infinite;
}

std::string Evidence::field_of(const Part& part) const {
  const bool contours = !is_trace(part) && data_.lumen[part.source]->sample_dimension() == 1;
  return std::string("observations.") +
         (is_trace(part) ? "traces."
          : contours     ? "contours."
                         : "surfaces.") +
         name_of(part);
}

MatrixXd Evidence::residuals(const std::vector<const FinishedMotion*>& runs) const {
  MatrixXd all = MatrixXd::Constant(static_cast<Eigen::Index>(residual_.size()), static_cast<Eigen::Index>(runs.size()),
                                    undefined);
  for (const Part& part : parts_)
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k]->failed()) continue;
      auto column = all.col(static_cast<Eigen::Index>(k)).segment(part.first, part.count);
      if (is_trace(part)) {
        const Trace& trace = data_.traces[part.source - data_.lumen.size()];
        const TraceDiscrepancy seen = compare(trace, runs[k]->trace(trace.observable));
        for (std::size_t i = 0; i < seen.times.size() && static_cast<Eigen::Index>(i) < part.count; ++i)
          column(static_cast<Eigen::Index>(i)) = seen.measured[i] - seen.model[i];
        continue;
      }
      const std::vector<Sample> samples =
          data_.lumen[part.source]->observe(runs[k]->motion.positions(part.time), part.frame);
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (samples[i].excluded == Exclusion::none) column(static_cast<Eigen::Index>(i)) = samples[i].distance;
    }
  return all;
}

EffectProblem Evidence::problem() const {
  EffectProblem problem;
  const auto n = static_cast<Eigen::Index>(residual_.size());
  problem.residual = Eigen::Map<const VectorXd>(residual_.data(), n);
  problem.precision = Eigen::Map<const VectorXd>(precision_.data(), n);
  problem.independent = Eigen::Map<const VectorXd>(independent_.data(), n);
  problem.block = block_;
  for (const Part& part : parts_)
    for (Eigen::Index i = part.first; i < part.first + part.count; ++i)
      if (precision_[static_cast<std::size_t>(i)] > 0)
        (held_out_[static_cast<std::size_t>(i)] ? problem.held_out : problem.training).push_back(i);
  problem.changes.resize(n, 0);
  problem.allowed.resize(n, 0);
  problem.patterns.resize(n, 0);
  return problem;
}

}  // namespace tether
