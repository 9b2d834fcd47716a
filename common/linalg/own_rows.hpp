#pragma once

#include <vector>

#include "common/linalg/share.hpp"

namespace tether {

/// A process's own rows of a shared matrix with one row a node, numbered for iterating on them: its own nodes first,
/// then those of others that its rows refer to.
class OwnRows {
 public:
  /// pattern: of the matrix, with all entries of the own rows.
  OwnRows(const Share& share, const SparseMatrix& pattern);

  int own() const { return own_; }
  int all() const { return static_cast<int>(nodes_.size()); }

  /// The values of `matrix`, which has the pattern.
  void take(const SparseMatrix& matrix);
  /// [own x all], and what of it refers to own nodes [own x own].
  const SparseMatrix& rows() const { return rows_; }
  const SparseMatrix& block() const { return block_; }

  /// Columns of a nodal field of the mesh: those of own nodes, or all.
  Points own_of(const Points& field) const;
  Points all_of(const Points& field) const;
  /// The own columns go to a nodal field of the mesh.
  void put_back(const Points& local, Points& field) const;

  /// Columns of others' nodes become what these have (local: 3 x all).
  void refresh(Points& local) const;
  Team& team() const { return share_->team(); }

 private:
  struct Neighbour {
    int rank = 0;
    std::vector<int> sends;       ///< own nodes, local
    int first = 0, received = 0;  ///< of the others' nodes: they stand together
    mutable std::vector<double> outgoing;
  };

  const Share* share_;
  int own_ = 0;
  std::vector<int> nodes_;  ///< of the mesh, by local number
  SparseMatrix rows_, block_;
  std::vector<int> from_, block_from_;  ///< where in the matrix's values each entry stands
  std::vector<Neighbour> neighbours_;
};

}  // namespace tether
