#include "common/linalg/own_rows.hpp"

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {
namespace {

struct Entry {
  int column, from;
};

/// Rows of entries, each sorted by column, as a matrix; `from` gets where its values come from.
SparseMatrix matrix_of(std::vector<std::vector<Entry>>& rows, int columns, std::vector<int>& from) {
  SparseMatrix matrix(static_cast<Eigen::Index>(rows.size()), columns);
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  matrix.resizeNonZeros(static_cast<Eigen::Index>(count));
  int place = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::sort(rows[i].begin(), rows[i].end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    matrix.outerIndexPtr()[i] = place;
    for (const Entry& entry : rows[i]) {
      matrix.innerIndexPtr()[place++] = entry.column;
      from.push_back(entry.from);
    }
  }
  matrix.outerIndexPtr()[rows.size()] = place;
  return matrix;
}

void take_values(const SparseMatrix& matrix, const std::vector<int>& from, SparseMatrix& to) {
  for (std::size_t k = 0; k < from.size(); ++k) to.valuePtr()[k] = matrix.valuePtr()[from[k]];
}

}  // namespace

OwnRows::OwnRows(const Share& share, const SparseMatrix& pattern)
    : share_(&share), own_(static_cast<int>(share.own().size())), nodes_(share.own().begin(), share.own().end()) {
  std::vector<int> local(static_cast<std::size_t>(share.nodes()), -1), others;
  for (int i = 0; i < own_; ++i) local[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(i)])] = i;
  for (int node : share.own())
    for (SparseMatrix::InnerIterator entry(pattern, node); entry; ++entry)
      if (const int other = static_cast<int>(entry.col()); local[static_cast<std::size_t>(other)] == -1) {
        local[static_cast<std::size_t>(other)] = -2;
        others.push_back(other);
      }
  std::sort(others.begin(), others.end(), [&share](int a, int b) {
    return share.owner(a) != share.owner(b) ? share.owner(a) < share.owner(b) : a < b;
  });
  for (int node : others) {
    local[static_cast<std::size_t>(node)] = all();
    if (neighbours_.empty() || neighbours_.back().rank != share.owner(node))
      neighbours_.push_back({share.owner(node), {}, all(), 0, {}});
    ++neighbours_.back().received;
    nodes_.push_back(node);
  }
  // What a neighbour needs of this process: the pattern is symmetric, so these are the own nodes that refer to its.
  for (Neighbour& neighbour : neighbours_) {
    for (int i = 0; i < own_; ++i)
      for (SparseMatrix::InnerIterator entry(pattern, nodes_[static_cast<std::size_t>(i)]); entry; ++entry)
        if (share.owner(static_cast<int>(entry.col())) == neighbour.rank) {
          neighbour.sends.push_back(i);
          break;
        }
    neighbour.outgoing.resize(3 * neighbour.sends.size());
  }

  std::vector<std::vector<Entry>> rows(static_cast<std::size_t>(own_)), block(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    int from = pattern.outerIndexPtr()[nodes_[i]];
    for (SparseMatrix::InnerIterator entry(pattern, nodes_[i]); entry; ++entry, ++from) {
      const int column = local[static_cast<std::size_t>(entry.col())];
      rows[i].push_back({column, from});
      if (column < own_) block[i].push_back({column, from});
    }
  }
  rows_ = matrix_of(rows, all(), from_);
  block_ = matrix_of(block, own_, block_from_);
}

void OwnRows::take(const SparseMatrix& matrix) {
  take_values(matrix, from_, rows_);
  take_values(matrix, block_from_, block_);
}

Points OwnRows::own_of(const Points& field) const {
  return field(Eigen::all, share_->own());
}

Points OwnRows::all_of(const Points& field) const {
  return field(Eigen::all, nodes_);
}

void OwnRows::put_back(const Points& local, Points& field) const {
  for (int i = 0; i < own_; ++i) field.col(nodes_[static_cast<std::size_t>(i)]) = local.col(i);
}

void OwnRows::refresh(Points& local) const {
  std::vector<Team::Parcel> outgoing, incoming;
  for (const Neighbour& neighbour : neighbours_) {
    for (std::size_t k = 0; k < neighbour.sends.size(); ++k)
      Eigen::Map<Vec3>(neighbour.outgoing.data() + 3 * k) = local.col(neighbour.sends[k]);
    outgoing.push_back({neighbour.rank, neighbour.outgoing});
    incoming.push_back({neighbour.rank,
                        {local.data() + 3 * static_cast<std::size_t>(neighbour.first),
                         3 * static_cast<std::size_t>(neighbour.received)}});
  }
  team().exchange(outgoing, incoming);
}

}  // namespace tether
