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

double time_within(double time, double start, double period) {
  return period > 0 ? time - period * std::floor((time - start) / period) : time;
}

}  // namespace

DataPrecision::DataPrecision(const Observations& data, const Points& imaged, double dt, std::pair<double, double> run)
    : dt_(dt), run_start_(run.first), run_length_(run.second - run.first) {
  std::vector<double> deviations;
  for (const auto& source : data.lumen) {
    const SourceSettings& settings = source->settings();
    const std::size_t first = series_.size();
    series_.resize(first + source->series_names().size(), {{}, settings.period, settings.noise.correlation_time, 0});
    double any_time = 0;
    for (const Frame& frame : source->frames())
      if (!frame.held_out)
        series_[first + static_cast<std::size_t>(frame.series)].times.push_back(any_time = frame.time);
    std::vector<double> observed(source->series_names().size(), 0.0);
    const std::vector<Sample> samples = source->observe(imaged, std::isnan(any_time) ? run.first : any_time);
    for (const Sample& sample : samples) {
      observed[static_cast<std::size_t>(sample.series)] += sample.weight;
      of_sample_.push_back(first + static_cast<std::size_t>(sample.series));
      deviations.push_back(settings.noise.deviation);
    }
    for (std::size_t i = 0; i < observed.size(); ++i)
      series_[first + i].precision = 1 / (std::pow(settings.noise.deviation, 2) *
                                          independent_part(settings.noise, source->sample_dimension(), observed[i]));
  }
  for (Series& series : series_) std::sort(series.times.begin(), series.times.end());
  for (const Trace& trace : data.traces) {
    traces_.push_back(
        {trace.times, trace.period, trace.noise.correlation_time, 1 / std::pow(trace.noise.deviation, 2)});
    deviations.push_back(trace.noise.deviation);
  }
  deviations_ = Eigen::Map<VectorXd>(deviations.data(), static_cast<Eigen::Index>(deviations.size()));
}

/// Of a frame's weight, what falls to a step that ends at `time`.
double DataPrecision::share_of_frame(const Series& series, double time) const {
  const auto& times = series.times;
  if (times.empty()) return 0;
  double apart = run_length_;
  if (times.size() > 1 || series.period > 0) {
    const double now = time_within(time, times.front(), series.period);
    const auto after = std::upper_bound(times.begin(), times.end(), now);
    const double last = after == times.begin() ? times.front() : *(after - 1);
    if (after != times.end())
      apart = *after - last;
    else if (series.period > 0)
      apart = times.front() + series.period - last;
    else
      apart = times.back() - times[times.size() - 2];
  }
  const double independent = independent_share(apart, series.correlation_time);
  return whole_frames_ ? independent : std::min(1.0, dt_ / apart) * independent;
}

VectorXd DataPrecision::of_samples(const VectorXd& weights, double time) const {
  TETHER_ASSERT(static_cast<std::size_t>(weights.size()) == of_sample_.size(), "{} weights of {} samples",
                weights.size(), of_sample_.size());
  std::vector<double> factors;
  for (const Series& series : series_) factors.push_back(series.precision * share_of_frame(series, time));  // (K.5)
  VectorXd precision(weights.size());
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    precision(i) = weights(i) * factors[of_sample_[static_cast<std::size_t>(i)]];
  return precision;
}

VectorXd DataPrecision::of_traces(double time) const {
  VectorXd precision = VectorXd::Zero(static_cast<Eigen::Index>(traces_.size()));
  for (std::size_t i = 0; i < traces_.size(); ++i) {
    const Series& trace = traces_[i];
    const double slack = 1e-9 * run_length_;
    const bool covered =
        trace.period > 0 || (time >= trace.times.front() - slack && time <= trace.times.back() + slack);
    if (covered) precision(static_cast<Eigen::Index>(i)) = trace.precision * share_of_frame(trace, time);
  }
  return precision;
}

bool DataPrecision::has_frame(double begin, double end) const {
  const double slack = 1e-9 * run_length_;
  for (const Series& series : series_)
    for (const double frame : series.times) {
      if (std::isnan(frame)) return true;
      const double first = series.period > 0 ? time_within(frame, run_start_ + slack, series.period) : frame;
      if (series.period <= 0
              ? first > begin + slack && first <= end + slack
              : std::floor((end + slack - first) / series.period) > std::floor((begin + slack - first) / series.period))
        return true;
    }
  return false;
}

void check_noise(const Observations& data, const CaseFile& file) {
  for (const auto& source : data.lumen) {
    const char* kind = source->sample_dimension() == 2 ? "surfaces." : "contours.";
    check(source->settings().noise, true, std::string("observations.") + kind + source->settings().name, file);
  }
  for (const Trace& trace : data.traces) check(trace.noise, false, "observations.traces." + trace.name, file);
}

}  // namespace tether
