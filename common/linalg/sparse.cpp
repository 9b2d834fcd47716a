#include "common/linalg/sparse.hpp"

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Sorted neighbours (itself included) of every node.
std::vector<std::vector<int>> neighbours(int node_count, std::size_t nodes, std::span<const int> connectivity) {
  std::vector<std::vector<int>> result(static_cast<std::size_t>(node_count));
  for (std::size_t e = 0; e < connectivity.size(); e += nodes)
    for (std::size_t a = 0; a < nodes; ++a)
      for (std::size_t b = 0; b < nodes; ++b)
        result[static_cast<std::size_t>(connectivity[e + a])].push_back(connectivity[e + b]);
  for (std::size_t node = 0; node < result.size(); ++node) {
    auto& list = result[node];
    list.push_back(static_cast<int>(node));
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

}  // namespace

ScatterMap::ScatterMap(int node_count, int components, std::size_t nodes, std::span<const int> connectivity)
    : components_(components), nodes_(nodes) {
  const auto lists = neighbours(node_count, nodes, connectivity);
  const int c = components;
  std::size_t entries = 0;
  for (const auto& list : lists) entries += list.size();
  pattern_.resize(node_count * c, node_count * c);
  pattern_.resizeNonZeros(static_cast<Eigen::Index>(entries) * c * c);
  int position = 0;
  for (int node = 0; node < node_count; ++node)
    for (int i = 0; i < c; ++i) {
      pattern_.outerIndexPtr()[node * c + i] = position;
      for (int other : lists[static_cast<std::size_t>(node)])
        for (int j = 0; j < c; ++j) pattern_.innerIndexPtr()[position++] = other * c + j;
    }
  pattern_.outerIndexPtr()[node_count * c] = position;
  std::fill_n(pattern_.valuePtr(), position, 0.0);

  locate(pattern_, connectivity);
}

void ScatterMap::locate(const SparseMatrix& pattern, std::span<const int> connectivity) {
  const int c = components_;
  const int* outer = pattern.outerIndexPtr();
  const int* inner = pattern.innerIndexPtr();
  starts_.reserve(connectivity.size() * nodes_);
  strides_.reserve(connectivity.size());
  for (std::size_t e = 0; e < connectivity.size(); e += nodes_)
    for (std::size_t a = 0; a < nodes_; ++a) {
      const int row = connectivity[e + a] * c;
      const int *begin = inner + outer[row], *end = inner + outer[row + 1];
      strides_.push_back(outer[row + 1] - outer[row]);
      for (std::size_t b = 0; b < nodes_; ++b) {
        const int column = connectivity[e + b] * c;
        const int* entry = std::lower_bound(begin, end, column);
        TETHER_ASSERT(entry != end && *entry == column, "no entry ({}, {})", row, column);
        starts_.push_back(static_cast<int>(entry - inner));
      }
    }
}

void constrain(SparseMatrix& matrix, std::span<const int> unknowns, double diagonal) {
  std::vector<char> fixed(static_cast<std::size_t>(matrix.rows()), 0);
  for (int unknown : unknowns) fixed[static_cast<std::size_t>(unknown)] = 1;
  for (int row = 0; row < matrix.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry)
      if (fixed[static_cast<std::size_t>(row)] || fixed[static_cast<std::size_t>(entry.col())])
        entry.valueRef() = row == entry.col() ? diagonal : 0.0;
}

}  // namespace tether
