#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/linalg/share.hpp"
#include "common/linalg/sparse.hpp"

namespace tether::block_of_springs {

using Cube = std::array<int, 8>;
using Cubes = std::vector<Cube>;

/// The cubes of a block of n x n x 2n nodes.
inline Cubes cubes(int n) {
  Cubes all;
  const auto node = [n](int i, int j, int k) { return (k * n + j) * n + i; };
  for (int k = 0; k + 1 < 2 * n; ++k)
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i)
        all.push_back({node(i, j, k), node(i + 1, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i, j, k + 1),
                       node(i + 1, j, k + 1), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1)});
  return all;
}

/// Springs between the nodes of each element, other ones in each, and the diagonal times `hold`: without it nothing
/// holds the body.
inline SparseMatrix assembled(int nodes, int components, const Cubes& elements, double hold) {
  const ScatterMap map(nodes, components, std::span<const Cube>(elements));
  SparseMatrix matrix = map.zero_matrix();
  const int size = 8 * components;
  std::vector<double> block(static_cast<std::size_t>(size * size));
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const double stiffness = 1 + 0.3 * std::sin(elements[e][0]);
    for (int a = 0; a < size; ++a)
      for (int b = 0; b < size; ++b) {
        const bool same_component = a % components == b % components;
        block[static_cast<std::size_t>(a * size + b)] =
            a == b           ? stiffness * (7 + hold)
            : same_component ? -stiffness
                             : 0.4 * hold * stiffness * (a / components == b / components ? 1 : 0);
      }
    map.add(matrix, e, block.data());
  }
  return matrix;
}

inline VectorXd some_load(Eigen::Index size) {
  return VectorXd::LinSpaced(size, 0, 1).unaryExpr([](double x) { return std::sin(37 * x); });
}

/// A process's owner of each node of the block with n x n x 2n nodes.
inline std::vector<int> owners(int n, int parts) {
  const SparseMatrix graph = assembled(2 * n * n * n, 1, cubes(n), 1);
  return cut_graph(graph, std::vector<int>(static_cast<std::size_t>(graph.rows()), 1), parts);
}

/// The block's matrix, of the elements at own nodes.
inline SparseMatrix assembled_here(const Share& share, int n, int components, double hold) {
  const Cubes all = cubes(n);
  Cubes here;
  for (const int number : share.elements_here(all)) here.push_back(all[static_cast<std::size_t>(number)]);
  return assembled(share.nodes(), components, here, hold);
}

}  // namespace tether::block_of_springs
