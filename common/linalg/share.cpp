#include "common/linalg/share.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {

Share::Share(int nodes) : team_(&alone()), nodes_(nodes) {}

Share::Share(Team& team, std::vector<int> owner) : team_(&team), nodes_(static_cast<int>(owner.size())) {
  if (team.is_alone()) return;
  owner_ = std::move(owner);
  by_owner_.resize(owner_.size());
  std::iota(by_owner_.begin(), by_owner_.end(), 0);
  std::stable_sort(by_owner_.begin(), by_owner_.end(),
                   [this](int a, int b) { return this->owner(a) < this->owner(b); });
  for (int rank = 0; rank <= team.size(); ++rank)
    starts_.push_back(
        static_cast<int>(std::lower_bound(by_owner_.begin(), by_owner_.end(), rank,
                                          [this](int node, int first) { return this->owner(node) < first; }) -
                         by_owner_.begin()));
  for (int rank = 0; rank < team.size(); ++rank)
    if (starts_[static_cast<std::size_t>(rank)] == starts_[static_cast<std::size_t>(rank) + 1])
      throw input_error("coupling.ranks: {} processes are too many for {} nodes: one of them would have none",
                        team.size(), nodes_);
}

std::span<const int> Share::own() const {
  TETHER_ASSERT(!is_whole(), "there is no list of all {} nodes", nodes_);
  const auto rank = static_cast<std::size_t>(team_->rank());
  return std::span(by_owner_).subspan(static_cast<std::size_t>(starts_[rank]),
                                      static_cast<std::size_t>(starts_[rank + 1] - starts_[rank]));
}

void Share::complete(std::span<double> field, int components) const {
  if (is_whole()) return;
  const auto c = static_cast<std::size_t>(components);
  TETHER_ASSERT(field.size() == c * static_cast<std::size_t>(nodes_), "{} numbers for {} nodes", field.size(), nodes_);
  std::vector<double> parts(field.size());
  std::vector<int> starts = starts_;
  for (int& start : starts) start *= components;
  const auto rank = static_cast<std::size_t>(team_->rank());
  const auto first = static_cast<std::size_t>(starts_[rank]), last = static_cast<std::size_t>(starts_[rank + 1]);
  const auto at = [&](std::size_t place) { return field.data() + static_cast<std::size_t>(by_owner_[place]) * c; };
  for (std::size_t place = first; place < last; ++place) std::copy_n(at(place), c, parts.data() + place * c);
  team_->gather(parts, starts);
  for (std::size_t place = 0; place < by_owner_.size(); ++place)
    if (place < first || place >= last) std::copy_n(parts.data() + place * c, c, at(place));
}

void Share::complete(VectorXd& field) const {
  if (is_whole()) return;
  TETHER_ASSERT(field.size() % nodes_ == 0, "{} numbers for {} nodes", field.size(), nodes_);
  complete({field.data(), static_cast<std::size_t>(field.size())}, static_cast<int>(field.size() / nodes_));
}

std::vector<int> cut_graph(const SparseMatrix& graph, std::span<const int> weights, int processes) {
  std::vector<int> owner(static_cast<std::size_t>(graph.rows()), 0);
  if (processes == 1) return owner;
  std::vector<idx_t> starts{0}, others, weight(weights.begin(), weights.end()), part(owner.size());
  for (int row = 0; row < graph.rows(); ++row) {
    for (SparseMatrix::InnerIterator entry(graph, row); entry; ++entry)
      if (entry.col() != row) others.push_back(static_cast<idx_t>(entry.col()));
    starts.push_back(static_cast<idx_t>(others.size()));
  }
  auto nodes = static_cast<idx_t>(owner.size()), constraints = idx_t{1}, parts = static_cast<idx_t>(processes),
       cut = idx_t{0};
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;  // all processes find the same parts
  const int status =
      METIS_PartGraphRecursive(&nodes, &constraints, starts.data(), others.data(), weight.data(), nullptr, nullptr,
                               &parts, nullptr, nullptr, options.data(), &cut, part.data());
  if (status != METIS_OK)
    throw run_error("the mesh could not be cut into {} parts (METIS status {})", processes, status);
  owner.assign(part.begin(), part.end());
  return owner;
}

}  // namespace tether
