#include "identification_master/data_precision.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "observation_manager/measurements/independence.hpp"

namespace tether {
namespace {

void check(const Noise& noise, bool in_place, const std::string& field, const CaseFile& file) {
  if (!(noise.deviation > 0))
    throw input_error("{}: must be given: how far single data err decides what they can tell",
                      file.where(field + ".noise.deviation"));
  if (in_place && !(noise.correlation_length > 0))
    throw input_error(
        "{}: must be given: neighbouring places of a segmentation err together; if they do not, give the size of a "
        "pixel",
        file.where(field + ".noise.correlation_length"));
}

}  // namespace

DataPrecision::DataPrecision(const Observations& data, const Points& imaged, double dt, std::pair<double, double> run) {
  const StepEnds ends{.start = run.first, .dt = dt, .length = run.second - run.first};
  for (const Measurement* source : data.all()) add(*source, imaged, ends);
}

void DataPrecision::add(const Measurement& source, const Points& imaged, const StepEnds& ends) {
  CountedRows rows = source.rows(imaged, ends.start);
  const MeasurementFacts facts = source.facts();
  for (const std::size_t number : rows.series_of) of_row_.push_back(series_.size() + number);
  for (CountedSeries& series : rows.series)
    series_.push_back({FrameSharing(std::move(series.times), series.period, series.tolerance, ends,
                                    series.correlation_time, series.curve),
                       series.correlation_time, series.precision});
  const Eigen::Index before = deviations_.size(), count = std::ssize(rows.series_of);
  deviations_.conservativeResize(before + count);
  deviations_.tail(count).setConstant(facts.held_out ? 0 : facts.noise.deviation);
}

DataPrecision::Weight DataPrecision::weight_of(const Series& series, double end_of_step) const {
  const SeenFrame seen = series.frames.at(end_of_step);
  const double share = whole_frames_ ? (seen.is_own ? 1.0 : 0.0) : seen.share;
  return {series.precision * share * independent_share(seen.apart, series.correlation_time), seen.error_square,
          seen.is_own};  // (K.5)
}

DatumWeights DataPrecision::at(const VectorXd& weights, double end_of_step) const {
  const auto rows = static_cast<Eigen::Index>(of_row_.size());
  TETHER_ASSERT(weights.size() == rows, "{} weights of {} rows", weights.size(), rows);
  std::vector<Weight> of_series;
  for (const Series& series : series_) of_series.push_back(weight_of(series, end_of_step));
  DatumWeights all{VectorXd(rows), VectorXd(rows), {}};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Weight& weight = of_series[of_row_[static_cast<std::size_t>(row)]];
    all.precision(row) = weights(row) * weight.factor;
    all.expected_squares(row) = weight.expected_square;
    all.on_frame.push_back(weight.on_frame);
  }
  return all;
}

bool DataPrecision::has_frame(double end_of_step) const {
  return std::any_of(series_.begin(), series_.end(),
                     [end_of_step](const Series& series) { return series.frames.at(end_of_step).is_own; });
}

void check_noise(const Observations& data, const CaseFile& file) {
  for (const Measurement* source : data.all())
    if (const MeasurementFacts facts = source->facts(); !facts.held_out)
      check(facts.noise, facts.kind.fallible.in_place, facts.field(), file);
}

}  // namespace tether
