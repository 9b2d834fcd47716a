#pragma once

#include <Eigen/SparseCore>

#include <array>
#include <span>
#include <vector>

namespace tether {

/// Square, rows sorted, pattern fixed once; symmetric matrices store both halves.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Sparsity of a finite element matrix and, per element, where its block entries land: assembly without search.
/// Unknowns are node-wise: unknown `node * components + component`.
class ScatterMap {
 public:
  ScatterMap() = default;

  /// elements: node lists of equal length. components: unknowns per node (1 or 3).
  template <std::size_t nodes>
  ScatterMap(int node_count, int components, std::span<const std::array<int, nodes>> elements)
      : ScatterMap(node_count, components, nodes,
                   {elements.empty() ? nullptr : elements[0].data(), nodes * elements.size()}) {}

  /// Elements (a boundary's triangles, say) whose blocks land in a matrix made for others. Throws InternalError where
  /// it has no entry.
  template <std::size_t nodes>
  ScatterMap(const SparseMatrix& pattern, int components, std::span<const std::array<int, nodes>> elements)
      : components_(components), nodes_(nodes) {
    locate(pattern, {elements.empty() ? nullptr : elements[0].data(), nodes * elements.size()});
  }

  int components() const { return components_; }
  /// A zero matrix with this pattern.
  SparseMatrix zero_matrix() const { return pattern_; }

  /// matrix += block of element e; block is (nodes*components)^2, row-major.
  void add(SparseMatrix& matrix, std::size_t element, const double* block) const {
    double* values = matrix.valuePtr();
    const int* start = starts_.data() + element * nodes_ * nodes_;
    const int* stride = strides_.data() + element * nodes_;
    const std::size_t c = static_cast<std::size_t>(components_), size = nodes_ * c;
    for (std::size_t a = 0; a < nodes_; ++a)
      for (std::size_t b = 0; b < nodes_; ++b)
        for (std::size_t i = 0; i < c; ++i)
          for (std::size_t j = 0; j < c; ++j)
            values[static_cast<std::size_t>(start[a * nodes_ + b]) + i * static_cast<std::size_t>(stride[a]) + j] +=
                block[(a * c + i) * size + b * c + j];
  }

 private:
  ScatterMap(int node_count, int components, std::size_t nodes, std::span<const int> connectivity);

  void locate(const SparseMatrix& pattern, std::span<const int> connectivity);

  int components_ = 0;
  std::size_t nodes_ = 0;
  SparseMatrix pattern_;
  std::vector<int> starts_;   ///< of block (a, b) of each element: position of its entry (0, 0)
  std::vector<int> strides_;  ///< of node a of each element: entries per matrix row
};

/// Symmetric elimination of unknowns with prescribed zero: row and column cleared, diagonal `diagonal`.
void constrain(SparseMatrix& matrix, std::span<const int> unknowns, double diagonal);

}  // namespace tether
