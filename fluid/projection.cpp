#include "fluid/projection.hpp"

#include "common/base/error.hpp"

namespace tether::fluid {

namespace {

/// Of unknowns that each stand for one node, or for those of an opening.
Share share_of_unknowns(const Share& nodes, const std::vector<int>& unknown_of, int unknowns) {
  if (nodes.is_whole()) return Share(unknowns);
  std::vector<int> owner(static_cast<std::size_t>(unknowns));
  for (std::size_t node = 0; node < unknown_of.size(); ++node)
    owner[static_cast<std::size_t>(unknown_of[node])] = nodes.owner(static_cast<int>(node));
  return Share(nodes.team(), std::move(owner));
}

}  // namespace

Projection::Projection(const FluidDomain& domain, const std::vector<std::vector<int>>& openings)
    : openings_(openings.size()), unknown_of_(static_cast<std::size_t>(domain.node_count()), -1), share_(0) {
  if (openings.empty())
    throw InputError(
        "the fluid needs an outlet, or an inlet with a given pressure: otherwise its pressure is undetermined");
  number(domain, openings);
  share_ = share_of_unknowns(domain.share(), unknown_of_, unknowns_);
  std::vector<Tetrahedron> elements = domain.tetrahedra();
  for (auto& element : elements)
    for (int& node : element) node = unknown_of_[static_cast<std::size_t>(node)];
  map_ = ScatterMap(unknowns_, 1, std::span<const Tetrahedron>(elements));
  matrix_ = map_.zero_matrix();
  solver_ = laplacian_solver(share_);
  solver_->analyze(matrix_);
}

void Projection::number(const FluidDomain& domain, const std::vector<std::vector<int>>& openings) {
  std::vector<int> owner(static_cast<std::size_t>(domain.node_count()), -1);
  for (std::size_t i = 0; i < openings.size(); ++i)
    for (int node : openings[i]) owner[static_cast<std::size_t>(node)] = static_cast<int>(i);
  for (std::size_t node = 0; node < owner.size(); ++node)
    if (owner[node] < 0) unknown_of_[node] = unknowns_++;
  for (std::size_t node = 0; node < owner.size(); ++node)
    if (owner[node] >= 0) unknown_of_[node] = unknowns_ + owner[node];
  unknowns_ += static_cast<int>(openings_);
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
    rows_[i] = row_of_opening(row);
    if (impedances_[i] == 0) prescribed.push_back(row);
  }
  for (std::size_t i = 0; i < openings_; ++i)
    if (impedances_[i] > 0 && share_.is_own(opening_unknown(i)))
      matrix_.coeffRef(opening_unknown(i), opening_unknown(i)) += 1 / impedances_[i];
  if (!prescribed.empty()) constrain(matrix_, prescribed, dt_over_rho);
  solver_->factor(matrix_);
}

/// Who does not answer for the opening has of its row what stands in the own rows too: the matrix is symmetric.
Projection::Row Projection::row_of_opening(int row) const {
  Row result;
  for (SparseMatrix::InnerIterator entry(matrix_, row); entry; ++entry) {
    const int column = static_cast<int>(entry.col());
    if (share_.is_own(column))
      result.emplace_back(column, share_.is_own(row) ? entry.value() : matrix_.coeff(column, row));
  }
  return result;
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
  p = solver_->solve(p);
  for (std::size_t i = 0; i < openings_; ++i)
    if (impedances_[i] == 0) p[opening_unknown(i)] = known[static_cast<Eigen::Index>(i)];

  Solution solution{p(unknown_of_), VectorXd(static_cast<Eigen::Index>(openings_))};
  for (std::size_t i = 0; i < openings_; ++i) {
    double flow = share_.is_own(opening_unknown(i)) ? condensed[opening_unknown(i)] : 0.0;
    for (const auto& [column, value] : rows_[i]) flow -= value * p[column];
    solution.flow[static_cast<Eigen::Index>(i)] = flow;
  }
  share_.team().sum({solution.flow.data(), openings_});
  return solution;
}

}  // namespace tether::fluid
