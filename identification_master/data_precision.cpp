#include "identification_master/data_precision.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Area or length of one independent error.
double independent_part(const Noise& noise, int dimension, double observed) {
  const double l = noise.correlation_length, part = dimension == 2 ? 2 * std::numbers::pi * l * l : 2 * l;
  return observed > 0 ? std::min(part, observed) : part;
}

/// What frames `apart` from each other count, of independent ones: 1/(1 + 2 sum_k exp(-k apart/tau)).
double independent_share(double apart, double correlation_time) {
  return correlation_time > 0 ? std::tanh(apart / (2 * correlation_time)) : 1;
}

void check(const Noise& noise, bool on_lumen, const std::string& field, const CaseFile& file) {
  if (!(noise.deviation > 0))
    throw input_error("{}: must be given: how far single data err decides what they can tell",
                      file.where(field + ".noise.deviation"));
  if (on_lumen && !(noise.correlation_length > 0))
    throw input_error(
        "{}: must be given: neighbouring places of a segmentation err together; if they do not, give the size of a "
        "pixel",
        file.where(field + ".noise.correlation_length"));
}

}  // namespace

DataPrecision::DataPrecision(const Observations& data, const Points& imaged, double dt, std::pair<double, double> run) {
  const StepEnds ends{.start = run.first, .dt = dt, .length = run.second - run.first};
  std::vector<double> deviations;
  for (const auto& source : data.lumen) {
    add_lumen_data(*source, imaged, ends);
    deviations.resize(of_sample_.size(), source->settings().noise.deviation);
  }
  for (const Trace& trace : data.traces) {
    add_trace(trace, ends);
    deviations.push_back(trace.held_out ? 0 : trace.noise.deviation);
  }
  deviations_ = Eigen::Map<VectorXd>(deviations.data(), static_cast<Eigen::Index>(deviations.size()));
}

void DataPrecision::add_lumen_data(const LumenSeries& source, const Points& imaged, const StepEnds& ends) {
  const SourceSettings& settings = source.settings();
  const std::size_t first = series_.size(), count = source.series_names().size();
  std::vector<std::vector<double>> times(count);
  double any_time = ends.start;
  for (const Frame& frame : source.frames())
    if (!frame.held_out) {
      times[static_cast<std::size_t>(frame.series)].push_back(frame.time);
      if (!std::isnan(frame.time)) any_time = frame.time;
    }
  std::vector<double> observed(count, 0.0);
  for (const Sample& sample : source.observe(imaged, any_time)) {
    observed[static_cast<std::size_t>(sample.series)] += sample.weight;
    of_sample_.push_back(first + static_cast<std::size_t>(sample.series));
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::sort(times[i].begin(), times[i].end());
    series_.push_back({FrameSharing(std::move(times[i]), settings.period, settings.time_tolerance, ends),
                       settings.noise.correlation_time,
                       1 / (std::pow(settings.noise.deviation, 2) *
                            independent_part(settings.noise, source.sample_dimension(), observed[i]))});
  }
}

void DataPrecision::add_trace(const Trace& trace, const StepEnds& ends) {
  const bool used = !trace.held_out;
  traces_.push_back({FrameSharing(used ? trace.times : std::vector<double>{}, trace.period, trace.tolerance, ends),
                     trace.noise.correlation_time, used ? 1 / std::pow(trace.noise.deviation, 2) : 0});
}

DataPrecision::Weight DataPrecision::weight_of(const Series& series, double end_of_step) const {
  const SeenFrame seen = series.frames.at(end_of_step);
  const double share = whole_frames_ ? (seen.is_own ? 1.0 : 0.0) : seen.share;
  const double s = seen.place, alike = series.correlation_time > 0 ? std::exp(-seen.gap / series.correlation_time) : 0;
  return {series.precision * share * independent_share(seen.apart, series.correlation_time),
          (1 - s) * (1 - s) + s * s + 2 * s * (1 - s) * alike, seen.is_own};  // (K.5)
}

DatumWeights DataPrecision::at(const VectorXd& weights_of_samples, double end_of_step) const {
  const auto samples = static_cast<Eigen::Index>(of_sample_.size());
  TETHER_ASSERT(weights_of_samples.size() == samples, "{} weights of {} samples", weights_of_samples.size(), samples);
  DatumWeights all{VectorXd(deviations_.size()), VectorXd(deviations_.size()), {}};
  const auto add = [&all](double sample_weight, const Weight& weight) {
    const auto row = static_cast<Eigen::Index>(all.on_frame.size());
    all.precision(row) = sample_weight * weight.factor;
    all.expected_squares(row) = weight.expected_square;
    all.on_frame.push_back(weight.on_frame);
  };
  std::vector<Weight> of_series;
  for (const Series& series : series_) of_series.push_back(weight_of(series, end_of_step));
  for (Eigen::Index i = 0; i < samples; ++i)
    add(weights_of_samples(i), of_series[of_sample_[static_cast<std::size_t>(i)]]);
  for (const Series& trace : traces_) add(1, weight_of(trace, end_of_step));
  return all;
}

bool DataPrecision::has_frame(double end_of_step) const {
  const auto is_own = [end_of_step](const Series& series) { return series.frames.at(end_of_step).is_own; };
  return std::any_of(series_.begin(), series_.end(), is_own) || std::any_of(traces_.begin(), traces_.end(), is_own);
}

void check_noise(const Observations& data, const CaseFile& file) {
  for (const auto& source : data.lumen) {
    const char* kind = source->sample_dimension() == 2 ? "surfaces." : "contours.";
    check(source->settings().noise, true, std::string("observations.") + kind + source->settings().name, file);
  }
  for (const Trace& trace : data.traces)
    if (!trace.held_out) check(trace.noise, false, "observations.traces." + trace.name, file);
}

}  // namespace tether
