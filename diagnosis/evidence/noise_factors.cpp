#include "diagnosis/evidence/noise_factors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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

std::vector<double> noise_factors(const EffectProblem& white, const std::vector<std::size_t>& source) {
  const std::vector<Index> rows = counted_rows(white);
  const std::size_t sources = source.empty() ? 0 : *std::max_element(source.begin(), source.end()) + 1;
  VectorXd squares = VectorXd::Constant(static_cast<Index>(sources), as_stated), count = squares;
  const MatrixXd columns = all_columns(white, rows);
  Eigen::ColPivHouseholderQR<MatrixXd> factor(columns);
  factor.setThreshold(1e-6);
  const MatrixXd basis =
      factor.householderQ() * MatrixXd::Identity(columns.rows(), std::min(columns.rows(), factor.rank()));
  const VectorXd data = white.residual(rows), left = data - basis * (basis.transpose() * data);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Index>(k), of = static_cast<Index>(source[static_cast<std::size_t>(rows[k])]);
    squares(of) += left(i) * left(i);
    count(of) += 1 - basis.row(i).squaredNorm();
  }
  std::vector<double> factors;
  for (Index s = 0; s < squares.size(); ++s)
    factors.push_back(std::clamp(std::sqrt(squares(s) / count(s)), 1.0, largest_noise_factor));
  return factors;
}

EffectProblem with_noise(EffectProblem white, const std::vector<std::size_t>& source,
                         const std::vector<double>& factors) {
  VectorXd less(white.residual.size());
  for (Index i = 0; i < less.size(); ++i) less(i) = 1 / factors[source[static_cast<std::size_t>(i)]];
  white.residual = less.asDiagonal() * white.residual;
  for (MatrixXd* columns : {&white.changes, &white.allowed, &white.patterns}) *columns = less.asDiagonal() * *columns;
  return white;
}

}  // namespace tether
