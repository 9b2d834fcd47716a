#include "diagnosis/noise/measured_noise.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/noise/noise_posterior.hpp"

namespace tether {
namespace {

/// Twice the difference of log likelihoods that tells a shape at 95 % (chi-square of one number).
constexpr double telling_shape = 3.84;
/// A remark that is wrong in one of a hundred right statements: it is made of every diagnosis.
constexpr double improbable = 0.01;
/// A deviation this much off changes a misfit by more than 40 %; a length this much off doubles the number of
/// independent errors.
constexpr double deviation_matters = 1.2, length_matters = 1.5;
/// As many more independent frames as data do by such a length.
constexpr double frames_matter = 2;

/// Off by more than `factor`, and not by chance.
bool is_off(const MeasuredNumber& ratio, double factor) {
  const bool is_sure = ratio.lower > 1 || ratio.upper < 1;
  return is_sure && std::abs(std::log(ratio.value)) > std::log(factor);
}

MeasuredNumber over(const MeasuredNumber& number, double stated) {
  return {number.value / stated, number.lower / stated, number.upper / stated};
}

NoiseCheck check_of(const std::vector<NoisePosterior>& shapes, const NoiseFit& best, const Noise& stated) {
  const auto chance = [&](std::optional<double> deviation, std::optional<double> length) {
    double with = -std::numeric_limits<double>::infinity();
    for (const NoisePosterior& shape : shapes) with = std::max(with, shape.log_likelihood_with(deviation, length));
    return chi_square_tail(std::max(0.0, 2 * (best.log_likelihood - with)), deviation && length ? 2 : 1);
  };
  NoiseCheck check;
  check.deviation = stated.deviation;
  check.correlation_length = stated.correlation_length;
  check.correlation_time = stated.correlation_time;
  check.deviation_ratio = over(best.deviation, stated.deviation);
  check.length_ratio = over(best.correlation_length, stated.correlation_length);
  check.p = chance(stated.deviation, stated.correlation_length);
  const bool is_deviation =
                 is_off(check.deviation_ratio, deviation_matters) && chance(stated.deviation, {}) < improbable,
             is_length =
                 is_off(check.length_ratio, length_matters) && chance({}, stated.correlation_length) < improbable;
  check.contradicts = check.p < improbable && (is_deviation || is_length);
  return check;
}

void check_time(NoiseCheck& check, const LastingErrors& lasting) {
  check.measured_time = lasting.time;
  check.time_contradicts =
      lasting.p_of_stated < improbable && std::abs(std::log(lasting.frames_claimed)) > std::log(frames_matter);
}

bool has_data_to_spare(const NoiseField& field) {
  return !field.frames.empty() && field.places.cols() >= 2 * field.free.cols() + 8;
}

/// Those with data to spare, thinned to what the work allows.
std::vector<NoiseField> usable(std::vector<NoiseField> fields, Eigen::Index most) {
  std::erase_if(fields, [](const NoiseField& field) { return !has_data_to_spare(field); });
  if (fields.empty()) throw run_error("noise cannot be measured: too few data in each frame");
  const double share = std::cbrt(static_cast<double>(fields.size()));
  return thinned(std::move(fields),
                 std::max<Eigen::Index>(60, static_cast<Eigen::Index>(static_cast<double>(most) / share)));
}

}  // namespace

bool can_be_measured(const std::vector<NoiseField>& fields) {
  return std::any_of(fields.begin(), fields.end(), has_data_to_spare);
}

MeasuredNoise measured_noise(const std::vector<NoiseField>& all, const Noise& stated, Eigen::Index most) {
  const RestrictedLikelihood likelihood(usable(all, most));
  std::vector<NoisePosterior> shapes;
  for (const CorrelationShape shape : {CorrelationShape::exponential, CorrelationShape::gaussian})
    shapes.emplace_back(likelihood, shape);
  MeasuredNoise result;
  for (const NoisePosterior& shape : shapes) result.fits.push_back(shape.fit());
  const bool second_leads = result.fits[1].log_likelihood > result.fits[0].log_likelihood;
  result.reaches_end = shapes[second_leads ? 1 : 0].reaches_end();
  if (second_leads) std::swap(result.fits[0], result.fits[1]);
  result.shape_difference = result.fits[0].log_likelihood - result.fits[1].log_likelihood;
  result.shape_is_told = 2 * result.shape_difference > telling_shape;
  for (const NoiseField& field : likelihood.fields())
    result.points = std::max(result.points, static_cast<int>(field.places.cols()));
  result.independent = static_cast<int>(likelihood.count());
  const auto lasting = lasting_errors(likelihood.fields(), result.fits[0], stated.correlation_time);
  if (lasting) result.correlation_time = lasting->time;
  result.correlation = correlation_by_distance(likelihood.fields(), result.fits);
  if (stated.deviation > 0 && stated.correlation_length > 0) {
    result.stated = check_of(shapes, result.fits[0], stated);
    if (lasting) check_time(*result.stated, *lasting);
  }
  return result;
}

}  // namespace tether
