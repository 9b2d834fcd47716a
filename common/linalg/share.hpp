#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/base/team.hpp"
#include "common/base/types.hpp"
#include "common/linalg/sparse.hpp"

namespace tether {

/// What of a mesh each process of a team answers for. All processes hold nodal fields of all nodes; of what one
/// assembles from the elements at its own nodes the entries of these are right, and `complete` brings those of the
/// others. So vectors need no numbering of their own, while elements, matrices and factors are shared out.
/// (docs/decisions/0125-several-processes.md)
class Share {
 public:
  /// All nodes are this process's.
  explicit Share(int nodes);
  /// `owner`: the rank of the process that answers for each node; it has at least one.
  Share(Team& team, std::vector<int> owner);

  Team& team() const { return *team_; }
  int nodes() const { return nodes_; }
  /// Whether all nodes are this process's.
  bool is_whole() const { return owner_.empty(); }
  int owner(int node) const { return is_whole() ? team_->rank() : owner_[static_cast<std::size_t>(node)]; }
  bool is_own(int node) const { return owner(node) == team_->rank(); }
  /// Of all nodes, those of the first process, of the second, and so on; each ascending. Empty if all are this one's.
  const std::vector<int>& by_owner() const { return by_owner_; }
  /// Where each process's begin there, and where the last one's end.
  const std::vector<int>& starts() const { return starts_; }
  std::span<const int> own() const;

  /// The numbers of the elements with an own node, ascending.
  template <std::size_t nodes>
  std::vector<int> elements_here(const std::vector<std::array<int, nodes>>& elements) const {
    std::vector<int> here;
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (int node : elements[e])
        if (is_own(node)) {
          here.push_back(static_cast<int>(e));
          break;
        }
    return here;
  }
  /// Whether this process answers for an element: the owner of its first node does.
  template <std::size_t nodes>
  bool answers_for(const std::array<int, nodes>& element) const {
    return is_own(element[0]);
  }

  /// A field of so many numbers a node: those of the others' nodes become what they have.
  void complete(std::span<double> field, int components) const;
  void complete(VectorXd& field) const;
  void complete(Points& field) const { complete({field.data(), static_cast<std::size_t>(field.size())}, 3); }

 private:
  Team* team_;
  int nodes_;
  std::vector<int> owner_, by_owner_, starts_;
};

/// An owner for each node of a graph, so that processes have nodes of about the same weight and few edges between them
/// (METIS). graph: the pattern of a matrix with one row a node. weights: of the nodes.
std::vector<int> cut_graph(const SparseMatrix& graph, std::span<const int> weights, int processes);

}  // namespace tether
