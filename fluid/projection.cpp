#include "fluid/projection.hpp"

#include "common/base/error.hpp"

namespace tether::fluid {

Projection::Projection(const FluidDomain& domain, const std::vector<std::vector<int>>& openings)
    : openings_(openings.size()), unknown_of_(static_cast<std::size_t>(domain.node_count()), -1) {
  if (openings.empty())
    throw InputError(
        "the fluid needs an outlet, or an inlet with a given pressure: otherwise its pressure is undetermined");
  std::vector<int> owner(unknown_of_.size(), -1);
  for (std::size_t i = 0; i < openings.size(); ++i)
    for (int node : openings[i]) owner[static_cast<std::size_t>(node)] = static_cast<int>(i);
  for (std::size_t node = 0; node < owner.size(); ++node)
    if (owner[node] < 0) unknown_of_[node] = unknowns_++;
  for (std::size_t node = 0; node < owner.size(); ++node)
    if (owner[node] >= 0) unknown_of_[node] = unknowns_ + owner[node];
  unknowns_ += static_cast<int>(openings_);

  std::vector<Tetrahedron> elements = domain.tetrahedra();
  for (auto& element : elements)
    for (int& node : element) node = unknown_of_[static_cast<std::size_t>(node)];
  map_ = ScatterMap(unknowns_, 1, std::span<const Tetrahedron>(elements));
  matrix_ = map_.zero_matrix();
  cholesky_.analyze(matrix_);
}

void Projection::assemble(const FluidDomain& domain, double dt_over_rho) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (std::size_t e = 0; e < domain.tetrahedra().size(); ++e) {
    const TetGeometry& g = domain.geometry()[e];
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block;
    block.noalias() = (dt_over_rho * g.volume) * g.grad_N.transpose() * g.grad_N;
    map_.add(matrix_, e, block.data());
  }
}

void Projection::factor(const FluidDomain& domain, double dt_over_rho, std::span<const double> impedances) {
  TETHER_ASSERT(impedances.size() == openings_, "{} impedances for {} openings", impedances.size(), openings_);
  impedances_.assign(impedances.begin(), impedances.end());
  assemble(domain, dt_over_rho);
  rows_.assign(openings_, {});
  std::vector<int> prescribed;
  for (std::size_t i = 0; i < openings_; ++i) {
    const int row = opening_unknown(i);
    for (SparseMatrix::InnerIterator entry(matrix_, row); entry; ++entry)
      rows_[i].emplace_back(static_cast<int>(entry.col()), entry.value());
    if (impedances_[i] == 0) prescribed.push_back(row);
  }
  for (std::size_t i = 0; i < openings_; ++i)
    if (impedances_[i] > 0) matrix_.coeffRef(opening_unknown(i), opening_unknown(i)) += 1 / impedances_[i];
  if (!prescribed.empty()) constrain(matrix_, prescribed, dt_over_rho);
  cholesky_.factor(matrix_);
}

Projection::Solution Projection::solve(const VectorXd& rhs, const VectorXd& known) const {
  VectorXd condensed = VectorXd::Zero(unknowns_);
  for (std::size_t node = 0; node < unknown_of_.size(); ++node)
    condensed[unknown_of_[node]] += rhs[static_cast<Eigen::Index>(node)];
  VectorXd p = condensed;
  for (std::size_t i = 0; i < openings_; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (impedances_[i] > 0)
      p[opening_unknown(i)] += known[index] / impedances_[i];
    else
      for (const auto& [column, value] : rows_[i]) p[column] -= value * known[index];
  }
  for (std::size_t i = 0; i < openings_; ++i)
    if (impedances_[i] == 0) p[opening_unknown(i)] = 0;
  p = cholesky_.solve(p);
  for (std::size_t i = 0; i < openings_; ++i)
    if (impedances_[i] == 0) p[opening_unknown(i)] = known[static_cast<Eigen::Index>(i)];

  Solution solution{p(unknown_of_), VectorXd(static_cast<Eigen::Index>(openings_))};
  for (std::size_t i = 0; i < openings_; ++i) {
    double flow = condensed[opening_unknown(i)];
    for (const auto& [column, value] : rows_[i]) flow -= value * p[column];
    solution.flow[static_cast<Eigen::Index>(i)] = flow;
  }
  return solution;
}

}  // namespace tether::fluid
