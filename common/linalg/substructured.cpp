#include "common/linalg/substructured.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/linalg/cholesky.hpp"
#include "common/linalg/rounded_factor.hpp"
#include "common/linalg/supernodal.hpp"

namespace tether {
namespace substructures {

/// Nodes with a neighbour that belongs to a process of a higher rank: without them the parts do not touch. The same
/// list in all processes, ascending.
std::vector<int> nodes_between(const Share& share, const SparseMatrix& matrix, int components) {
  VectorXd is_between = VectorXd::Zero(share.nodes());
  for (const int node : share.own())
    for (SparseMatrix::InnerIterator entry(matrix, node * components); entry; ++entry)
      if (share.owner(static_cast<int>(entry.col()) / components) > share.team().rank()) is_between[node] = 1;
  share.complete(is_between);
  std::vector<int> nodes;
  for (int node = 0; node < share.nodes(); ++node)
    if (is_between[node] != 0) nodes.push_back(node);
  return nodes;
}

/// Place of an unknown in a list of nodes with so many unknowns each; -1: its node is not there.
class Numbering {
 public:
  Numbering(const std::vector<int>& nodes, int all, int components)
      : components_(components), place_(static_cast<std::size_t>(all), -1) {
    for (std::size_t i = 0; i < nodes.size(); ++i) place_[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  }
  int of_node(int node) const { return place_[static_cast<std::size_t>(node)]; }
  int operator()(int unknown) const {
    const int place = of_node(unknown / components_);
    return place < 0 ? -1 : place * components_ + unknown % components_;
  }

 private:
  int components_;
  std::vector<int> place_;
};

/// Rows and columns of a matrix that are in a list of nodes, as a matrix of their own, and where its values come from.
struct Extract {
  SparseMatrix matrix;
  std::vector<int> from;

  Extract() = default;
  Extract(const SparseMatrix& all, const std::vector<int>& nodes, const Numbering& place, int components) {
    struct Entry {
      int column, from;
    };
    const auto size = static_cast<Eigen::Index>(nodes.size()) * components;
    std::vector<int> starts{0};
    std::vector<Entry> entries;
    for (const int node : nodes)
      for (int row = node * components; row < (node + 1) * components; ++row) {
        int position = all.outerIndexPtr()[row];
        for (SparseMatrix::InnerIterator entry(all, row); entry; ++entry, ++position)
          if (const int column = place(static_cast<int>(entry.col())); column >= 0)
            entries.push_back({column, position});
        std::sort(entries.begin() + starts.back(), entries.end(),
                  [](const Entry& one, const Entry& other) { return one.column < other.column; });
        starts.push_back(static_cast<int>(entries.size()));
      }
    matrix.resize(size, size);
    matrix.resizeNonZeros(static_cast<Eigen::Index>(entries.size()));
    std::copy(starts.begin(), starts.end(), matrix.outerIndexPtr());
    from.resize(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      matrix.innerIndexPtr()[k] = entries[k].column;
      from[k] = entries[k].from;
    }
  }
  void take(const SparseMatrix& all) {
    for (std::size_t k = 0; k < from.size(); ++k) matrix.valuePtr()[k] = all.valuePtr()[from[k]];
  }
};

}  // namespace substructures

struct SubstructuredSolver::Parts {
  explicit Parts(const Share& of_nodes) : share(of_nodes) { prepare_cholmod(common); }
  ~Parts() {
    rounded.drop();
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void find_nodes(const SparseMatrix& matrix);
  void order();
  std::vector<int> of_all(const std::vector<int>& mine, std::vector<int>& starts) const;
  void find_pattern_between();
  void set_pattern_between(std::vector<std::vector<int>>& neighbours);
  bool factor_inside(const SparseMatrix& matrix);
  Eigen::MatrixXd complement() const;
  bool factor_between(const SparseMatrix& matrix);
  void solve(VectorXd& rhs) const;
  template <class Scalar, class Solve>
  void in_order(VectorXd& part, const Solve& solve) const;

  int inside() const { return static_cast<int>(inner.size()) * components; }
  int edge() const { return static_cast<int>(edge_nodes.size()) * components; }

  const Share& share;
  int components = 1;
  std::vector<int> between;            ///< nodes between the parts, of all processes
  std::vector<int> inner;              ///< own nodes inside this part
  std::vector<int> edge_nodes;         ///< nodes between that the inner ones touch
  std::vector<int> edge_places;        ///< where they stand in `between`
  substructures::Extract part;         ///< inner nodes, then those of the edge
  substructures::Extract own_between;  ///< of nodes between: what of their matrix is in own rows
  VectorXd added;                 ///< to the diagonal of the edge, so that a part that nothing holds can be factored
  SparseMatrix sum;               ///< of all nodes between
  std::vector<int> block_places;  ///< of the block of the own edge, one a pair of nodes: where in the row of `sum`
  std::vector<int> targets;       ///< in the values of `sum`, of the own rows
  std::vector<std::size_t> sent_from_own;  ///< of own_between's entries, those in own rows
  Cholesky of_sum;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  RoundedFactor rounded{common};
  bool has_factor = false;
};

void SubstructuredSolver::Parts::find_nodes(const SparseMatrix& matrix) {
  between = substructures::nodes_between(share, matrix, components);
  const substructures::Numbering place_between(between, share.nodes(), components);
  std::vector<char> touched(between.size(), 0);
  inner.clear();
  edge_nodes.clear();
  for (const int node : share.own()) {
    if (place_between.of_node(node) >= 0) continue;
    inner.push_back(node);
    for (SparseMatrix::InnerIterator entry(matrix, node * components); entry; ++entry)
      if (const int place = place_between.of_node(static_cast<int>(entry.col()) / components); place >= 0)
        touched[static_cast<std::size_t>(place)] = 1;
  }
  edge_places.clear();
  for (std::size_t k = 0; k < between.size(); ++k)
    if (touched[k] != 0) {
      edge_nodes.push_back(between[k]);
      edge_places.push_back(static_cast<int>(k));
    }
  std::vector<int> all = inner;
  all.insert(all.end(), edge_nodes.begin(), edge_nodes.end());
  part = substructures::Extract(matrix, all, substructures::Numbering(all, share.nodes(), components), components);
  own_between = substructures::Extract(matrix, between, place_between, components);
}

/// Inner nodes as METIS wants them, then the edge.
void SubstructuredSolver::Parts::order() {
  cholmod_free_factor(&factor, &common);
  if (inner.empty()) return;
  std::vector<int> numbers(inner.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
  const substructures::Extract inside_alone(
      part.matrix, numbers,
      substructures::Numbering(numbers, static_cast<int>(part.matrix.rows()) / components, components), components);
  std::vector<int> unknowns = order_by_nodes(inside_alone.matrix, components, common);
  for (int k = inside(); k < part.matrix.rows(); ++k) unknowns.push_back(k);
  cholmod_sparse a = view_of(part.matrix);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 0;  // it would mix the edge with the inside; METIS' order is one already
  factor = cholmod_analyze_p(&a, unknowns.data(), nullptr, 0, &common);
  if (factor == nullptr) throw run_error("the analysis of a sparse matrix failed (CHOLMOD status {})", common.status);
  if (factor->is_super == 0) throw run_error("CHOLMOD makes no supernodal factor of {} unknowns", part.matrix.rows());
}

/// All processes' lists, one after the other; `starts` gets where each begins.
std::vector<int> SubstructuredSolver::Parts::of_all(const std::vector<int>& mine, std::vector<int>& starts) const {
  Team& team = share.team();
  std::vector<double> counts(static_cast<std::size_t>(team.size()), 0.0);
  const auto rank = static_cast<std::size_t>(team.rank());
  counts[rank] = static_cast<double>(mine.size());
  team.sum(counts);
  starts.assign(1, 0);
  for (const double count : counts) starts.push_back(starts.back() + static_cast<int>(count));
  std::vector<double> all(static_cast<std::size_t>(starts.back()));
  std::copy(mine.begin(), mine.end(), all.begin() + starts[rank]);
  team.gather(all, starts);
  return {all.begin(), all.end()};
}

/// Who contributes to which place of the matrix between the parts: each process a full block of its edge, and its own
/// rows.
void SubstructuredSolver::Parts::find_pattern_between() {
  std::vector<int> rows, columns, edge_starts;
  sent_from_own.clear();
  std::size_t k = 0;
  for (int row = 0; row < own_between.matrix.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(own_between.matrix, row); entry; ++entry, ++k)
      if (share.is_own(between[static_cast<std::size_t>(row / components)])) {
        sent_from_own.push_back(k);
        rows.push_back(row);
        columns.push_back(static_cast<int>(entry.col()));
      }
  const std::vector<int> edges_of_all = of_all(edge_places, edge_starts);
  const std::vector<int> own_rows = rows, own_columns = columns;
  std::vector<int> ignored;
  rows = of_all(rows, ignored);
  columns = of_all(columns, ignored);

  std::vector<std::vector<int>> neighbours(between.size());
  for (std::size_t r = 0; r + 1 < edge_starts.size(); ++r) {
    const auto begin = edges_of_all.begin() + edge_starts[r], end = edges_of_all.begin() + edge_starts[r + 1];
    std::for_each(begin, end, [&](int node) {
      auto& those = neighbours[static_cast<std::size_t>(node)];
      those.insert(those.end(), begin, end);
    });
  }
  for (std::size_t e = 0; e < rows.size(); ++e)
    neighbours[static_cast<std::size_t>(rows[e] / components)].push_back(columns[e] / components);
  set_pattern_between(neighbours);

  const auto place_in_row = [this, &neighbours](int row_node, int column_node) {
    const auto& those = neighbours[static_cast<std::size_t>(row_node)];
    return static_cast<int>(std::lower_bound(those.begin(), those.end(), column_node) - those.begin()) * components;
  };
  block_places.clear();
  for (const int row : edge_places)
    for (const int column : edge_places) block_places.push_back(place_in_row(row, column));
  targets.clear();
  for (std::size_t e = 0; e < own_rows.size(); ++e)
    targets.push_back(sum.outerIndexPtr()[own_rows[e]] +
                      place_in_row(own_rows[e] / components, own_columns[e] / components) +
                      own_columns[e] % components);
  if (!between.empty()) of_sum.analyze(sum, components);
}

/// neighbours: of each node between, as they come; sorted and each once afterwards.
void SubstructuredSolver::Parts::set_pattern_between(std::vector<std::vector<int>>& neighbours) {
  Eigen::Index count = 0;
  for (std::vector<int>& those : neighbours) {
    std::sort(those.begin(), those.end());
    those.erase(std::unique(those.begin(), those.end()), those.end());
    count += static_cast<Eigen::Index>(those.size()) * components * components;
  }
  const auto size = static_cast<Eigen::Index>(between.size()) * components;
  if (count > std::numeric_limits<int>::max())
    throw run_error("coupling.ranks: {} unknowns between the parts of {} processes are too many: fewer would do", size,
                    share.team().size());
  sum.resize(size, size);
  sum.resizeNonZeros(count);
  int at = 0, row = 0;
  for (const std::vector<int>& those : neighbours)
    for (int i = 0; i < components; ++i) {
      sum.outerIndexPtr()[row++] = at;
      for (const int node : those)
        for (int j = 0; j < components; ++j) sum.innerIndexPtr()[at++] = node * components + j;
    }
  sum.outerIndexPtr()[row] = at;
}

/// The own inside, and as many columns of the edge, whose triangle is what the inside leaves of it.
bool SubstructuredSolver::Parts::factor_inside(const SparseMatrix& matrix) {
  if (inner.empty()) return true;
  rounded.drop();
  part.take(matrix);
  added.resize(edge());
  for (int k = 0; k < edge(); ++k) {
    double& diagonal = part.matrix.coeffRef(inside() + k, inside() + k);
    added[k] = std::abs(diagonal);
    diagonal += added[k];
  }
  cholmod_sparse a = view_of(part.matrix);
  cholmod_factorize(&a, factor, &common);
  if (common.status < 0) throw run_error("a sparse factorisation failed (CHOLMOD status {})", common.status);
  return common.status != CHOLMOD_NOT_POSDEF;
}

/// What the inside adds to the matrix of the edge: - A_ei A_ii^-1 A_ie = L_ee L_ee' - (A_ee + added).
Eigen::MatrixXd SubstructuredSolver::Parts::complement() const {
  const int n = edge(), first = inside();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n), triangle = result;
  if (inner.empty() || n == 0) return result;
  for (std::size_t k = 0; k < factor->nsuper; ++k) {
    const Supernode node(*factor, k);
    for (int c = std::max(0, first - node.first); c < node.columns; ++c) {
      const double* column = node.triangle + static_cast<std::size_t>(c) * static_cast<std::size_t>(node.height);
      const int j = node.first + c - first;
      for (int i = c; i < node.columns; ++i) triangle(node.first + i - first, j) = column[i];
      for (int i = 0; i < node.below(); ++i) triangle(node.rows[i] - first, j) = column[node.columns + i];
    }
  }
  result.selfadjointView<Eigen::Lower>().rankUpdate(triangle);
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  for (int row = 0; row < n; ++row)
    for (SparseMatrix::InnerIterator entry(part.matrix, first + row); entry; ++entry)
      if (entry.col() >= first) result(row, entry.col() - first) -= entry.value();
  return result;
}

bool SubstructuredSolver::Parts::factor_between(const SparseMatrix& matrix) {
  if (between.empty()) return true;
  own_between.take(matrix);
  std::fill_n(sum.valuePtr(), sum.nonZeros(), 0.0);
  const Eigen::MatrixXd block = complement();
  const double* value = block.data();  // symmetric: by columns is by rows
  const int* places = block_places.data();
  for (const int node : edge_places) {
    for (int i = 0; i < components; ++i) {
      double* row = sum.valuePtr() + sum.outerIndexPtr()[node * components + i];
      for (std::size_t column = 0; column < edge_places.size(); ++column)
        for (int j = 0; j < components; ++j) row[places[column] + j] += *value++;
    }
    places += edge_places.size();
  }
  for (std::size_t k = 0; k < targets.size(); ++k)
    sum.valuePtr()[targets[k]] += own_between.matrix.valuePtr()[sent_from_own[k]];
  share.team().sum({sum.valuePtr(), static_cast<std::size_t>(sum.nonZeros())});
  return of_sum.factor_if_definite(sum);
}

template <class Scalar, class Solve>
void SubstructuredSolver::Parts::in_order(VectorXd& x, const Solve& solve) const {
  const double largest = x.cwiseAbs().maxCoeff(),
               scale = largest > 0 ? largest : 1;  // single precision has a small range
  const int* permutation = static_cast<const int*>(factor->Perm);
  std::vector<Scalar> ordered(factor->n), other(factor->n);
  for (std::size_t i = 0; i < factor->n; ++i) ordered[i] = static_cast<Scalar>(x[permutation[i]] / scale);
  solve(ordered.data(), other.data());
  for (std::size_t i = 0; i < factor->n; ++i) x[permutation[i]] = scale * static_cast<double>(ordered[i]);
}

void SubstructuredSolver::Parts::solve(VectorXd& rhs) const {
  VectorXd x = VectorXd::Zero(part.matrix.rows()), outer = VectorXd::Zero(sum.rows());
  const auto each = [this](const std::vector<int>& nodes, const auto& visit) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int c = 0; c < components; ++c)
        visit(static_cast<Eigen::Index>(i) * components + c, static_cast<Eigen::Index>(nodes[i]) * components + c);
  };
  const auto inside_alone = [&](const auto& exact, const auto& rough) {
    if (inner.empty()) return;
    if (rounded.is_empty())
      in_order<double>(x, exact);
    else
      in_order<float>(x, rough);
  };
  each(inner, [&](auto here, auto there) { x[here] = rhs[there]; });
  inside_alone([&](double* ordered, double* other) { solve_forward(*factor, inside(), ordered, other); },
               [&](float* ordered, float* /*other*/) { rounded.solve_forward(ordered); });
  each(between, [&](auto here, auto there) {
    if (share.is_own(static_cast<int>(there) / components)) outer[here] = rhs[there];
  });
  each(edge_places, [&](auto here, auto there) { outer[there] += x[inside() + here]; });
  share.team().sum({outer.data(), static_cast<std::size_t>(outer.size())});
  if (!between.empty()) outer = of_sum.solve(outer);
  each(edge_places, [&](auto here, auto there) { x[inside() + here] = outer[there]; });
  inside_alone([&](double* ordered, double* other) { solve_backward(*factor, inside(), ordered, other); },
               [&](float* ordered, float* /*other*/) { rounded.solve_backward(ordered); });
  each(inner, [&](auto here, auto there) { rhs[there] = x[here]; });
  each(between, [&](auto here, auto there) { rhs[there] = outer[here]; });
  share.complete({rhs.data(), static_cast<std::size_t>(rhs.size())}, components);
}

SubstructuredSolver::SubstructuredSolver(const Share& share) : parts_(std::make_unique<Parts>(share)) {}
SubstructuredSolver::~SubstructuredSolver() = default;

void SubstructuredSolver::analyze(const SparseMatrix& matrix, int components) {
  Parts& p = *parts_;
  TETHER_ASSERT(matrix.rows() == Eigen::Index{p.share.nodes()} * components, "{} rows of {} nodes", matrix.rows(),
                p.share.nodes());
  p.components = components;
  p.has_factor = false;
  p.find_nodes(matrix);
  p.share.team().each([&p] { p.order(); });
  p.find_pattern_between();
}

bool SubstructuredSolver::factor_if_definite(const SparseMatrix& matrix) {
  Parts& p = *parts_;
  if (p.sum.rows() == 0 && p.inner.empty()) analyze(matrix);
  double indefinite = 0;
  p.share.team().each([&] { indefinite = p.factor_inside(matrix) ? 0 : 1; });
  p.has_factor = p.share.team().sum(indefinite) == 0 && p.factor_between(matrix);
  return p.has_factor;
}

bool SubstructuredSolver::factor_roughly(const SparseMatrix& matrix, double tolerance) {
  if (!factor_if_definite(matrix)) return false;
  Parts& p = *parts_;
  if (p.factor != nullptr) p.rounded.take(*p.factor, p.inside());
  return solves_within(tolerance, matrix) || factor_if_definite(matrix);
}

void SubstructuredSolver::solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
    VectorXd column = rhs.col(k);
    parts_->solve(column);
    rhs.col(k) = column;
  }
}

bool SubstructuredSolver::has_factor() const {
  return parts_->has_factor;
}

double SubstructuredSolver::factor_megabytes() const {
  const Parts& p = *parts_;
  if (p.factor == nullptr) return p.of_sum.factor_megabytes();
  const double exact = 8e-6 * static_cast<double>(p.factor->xsize);
  return (p.rounded.is_empty() ? exact : p.rounded.megabytes()) + p.of_sum.factor_megabytes();
}

Eigen::Index SubstructuredSolver::between() const {
  return parts_->sum.rows();
}

}  // namespace tether
