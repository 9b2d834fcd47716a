#include "diagnosis/evidence/noise_factors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double as_stated = 20;  ///< data that err as stated, in the balance against those that are there

/// Those that say how large the noise is.
std::vector<Index> counted_rows(const EffectProblem& white) {
  std::vector<Index> rows = white.training;
  rows.insert(rows.end(), white.held_out.begin(), white.held_out.end());
  std::erase_if(rows, [&](Index i) {
    return !(white.independent(i) > 0) || std::count(white.sealed.begin(), white.sealed.end(), i) > 0;
  });
  return rows;
}

/// Directions in which data may be off by more than noise.
MatrixXd all_columns(const EffectProblem& white, const std::vector<Index>& rows) {
  MatrixXd all(rows.size(), white.allowed.cols() + white.patterns.cols() + white.changes.cols());
  all << white.allowed(rows, Eigen::all), white.patterns(rows, Eigen::all), white.changes(rows, Eigen::all);
  const Eigen::RowVectorXd size = all.colwise().norm().cwiseMax(1e-300);
  return all.array().rowwise() / size.array();
}

}  // namespace

NoiseFactors noise_factors(const EffectProblem& white, const std::vector<NoiseBand>& bands) {
  const std::vector<Index> rows = counted_rows(white);
  const MatrixXd columns = all_columns(white, rows);
  Eigen::ColPivHouseholderQR<MatrixXd> factor(columns);
  factor.setThreshold(1e-6);
  const MatrixXd basis =
      factor.householderQ() * MatrixXd::Identity(columns.rows(), std::min(columns.rows(), factor.rank()));
  const VectorXd data = white.residual(rows), left = data - basis * (basis.transpose() * data);
  struct Sum {
    double squares = as_stated, count = as_stated;
  };
  std::map<NoiseBand, Sum> sums;
  for (const NoiseBand& band : bands) sums.try_emplace(band);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Index>(k);
    Sum& sum = sums[bands[static_cast<std::size_t>(rows[k])]];
    sum.squares += left(i) * left(i);
    sum.count += 1 - basis.row(i).squaredNorm();
  }
  NoiseFactors factors;
  for (const auto& [band, sum] : sums)
    factors[band] = std::clamp(std::sqrt(sum.squares / sum.count), 1.0,
                               band.is_long ? largest_of_long_waves : largest_noise_factor);
  return factors;
}

VectorXd larger_noise(const std::vector<NoiseBand>& bands, const NoiseFactors& factors) {
  VectorXd larger(static_cast<Index>(bands.size()));
  for (Index i = 0; i < larger.size(); ++i) larger(i) = factors.at(bands[static_cast<std::size_t>(i)]);
  return larger;
}

EffectProblem with_noise(EffectProblem white, const VectorXd& larger) {
  const VectorXd less = larger.cwiseInverse();
  white.residual = less.asDiagonal() * white.residual;
  for (MatrixXd* columns : {&white.changes, &white.allowed, &white.patterns}) *columns = less.asDiagonal() * *columns;
  return white;
}

}  // namespace tether
