#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "diagnosis/noise/measured_noise.hpp"
#include "diagnosis/noise/restricted_likelihood.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr int bins = 24;
constexpr double reach = 5;    ///< lengths, beyond which nothing is alike
constexpr double fewest = 20;  ///< pairs whose mean says anything

/// A fit's covariance of what is left once the free columns are fitted, over its variance.
MatrixXd expected(const NoiseField& field, const NoiseFit& fit) {
  const Index n = field.places.cols();
  MatrixXd all(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      all(i, j) = i == j ? 1
                         : (1 - fit.nugget.value) * correlation_at((field.places.col(i) - field.places.col(j)).norm(),
                                                                   fit.correlation_length.value, fit.shape);
  const MatrixXd left = all - field.free * (field.free.transpose() * all);
  return left - (left * field.free) * field.free.transpose();
}

MatrixXd measured(const NoiseField& field) {
  MatrixXd all = MatrixXd::Zero(field.places.cols(), field.places.cols());
  for (const NoiseFrame& frame : field.frames) {
    const VectorXd left = frame.values - field.free * (field.free.transpose() * frame.values);
    all += left * left.transpose();
  }
  return all / static_cast<double>(field.frames.size());
}

void add(CorrelationBin& bin, double apart, double product, double exponential, double gaussian) {
  bin.pairs += 1;
  bin.distance += apart, bin.measured += product, bin.exponential += exponential, bin.gaussian += gaussian;
}

}  // namespace

std::vector<CorrelationBin> correlation_by_distance(const std::vector<NoiseField>& fields,
                                                    const std::vector<NoiseFit>& fits) {
  const bool first_is_exponential = fits[0].shape == CorrelationShape::exponential;
  const NoiseFit &exponential = fits[first_is_exponential ? 0 : 1], &gaussian = fits[first_is_exponential ? 1 : 0];
  const double width = reach * fits[0].correlation_length.value / bins, variance = std::pow(fits[0].deviation.value, 2);
  std::vector<CorrelationBin> all(bins);
  for (const NoiseField& field : fields) {
    const MatrixXd one = expected(field, exponential), other = expected(field, gaussian), products = measured(field);
    for (Index j = 0; j < products.cols(); ++j)
      for (Index i = 0; i < j; ++i) {
        const double apart = (field.places.col(i) - field.places.col(j)).norm();
        const auto bin = static_cast<std::size_t>(apart / width);
        if (bin < all.size()) add(all[bin], apart, products(i, j) / variance, one(i, j), other(i, j));
      }
  }
  std::erase_if(all, [](const CorrelationBin& bin) { return bin.pairs < fewest; });
  for (CorrelationBin& bin : all)
    for (double* sum : {&bin.distance, &bin.measured, &bin.exponential, &bin.gaussian}) *sum /= bin.pairs;
  return all;
}

}  // namespace tether
