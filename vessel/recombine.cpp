#include "vessel/recombine.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/base/error.hpp"
#include "common/mesh/locator.hpp"
#include "common/mesh/mesh.hpp"
#include "common/mesh/topology.hpp"

namespace tether {

namespace {

/// Nodes of the wall as columns of layers: column = the inner node below.
class Layers {
 public:
  Layers(const Points& points, const std::vector<Tetrahedron>& tetrahedra, const std::vector<Triangle>& inner,
         std::string name)
      : points_(points),
        tetrahedra_(tetrahedra),
        inner_(inner),
        name_(std::move(name)),
        level_(size(), -1),
        column_(size(), -1),
        above_(size(), -1) {
    find_levels();
    find_partners();
  }

  std::vector<Prism> prisms() const {
    std::vector<Prism> prisms;
    std::vector<Triangle> layer = inner_;
    for (int k = 0; k < top_; ++k)
      for (Triangle& t : layer) {
        const Triangle next{above(t[0]), above(t[1]), above(t[2])};
        prisms.push_back({t[0], t[1], t[2], next[0], next[1], next[2]});
        t = next;
      }
    return prisms;
  }

  /// No tetrahedron may connect columns that do not stand on one triangle of the inner surface, or across the edge of
  /// two.
  void verify() const {
    const std::set<Edge> neighbours = neighbouring_columns();
    for (const Tetrahedron& t : tetrahedra_)
      for (const int a : t)
        for (const int b : t)
          if (at(column_, a) < at(column_, b) && !neighbours.contains({at(column_, a), at(column_, b)}))
            fail(a, "a tetrahedron reaches beyond two neighbouring prisms");
  }

  [[noreturn]] void fail(int node, const std::string& what) const {
    throw input_error(
        "{}: the wall is not made of layers ({}, near ({:.4g}, {:.4g}, {:.4g})): give a layered wall, choose "
        "solid.element: p1, "
        "or leave the wall's mesh out and give its thickness",
        name_, what, points_(0, node), points_(1, node), points_(2, node));
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(points_.cols()); }
  static int& at(std::vector<int>& of, int node) { return of[static_cast<std::size_t>(node)]; }
  static int at(const std::vector<int>& of, int node) { return of[static_cast<std::size_t>(node)]; }
  int above(int node) const { return at(above_, node); }

  /// Layer of each node: the number of edges to the inner surface.
  void find_levels() {
    for (const int node : nodes_of(inner_)) at(level_, node) = 0, at(column_, node) = node;
    for (bool grown = true; grown; ++top_) {
      grown = false;
      for (const Tetrahedron& t : tetrahedra_) {
        if (std::none_of(t.begin(), t.end(), [&](int node) { return at(level_, node) == top_; })) continue;
        for (const int node : t)
          if (at(level_, node) < 0) at(level_, node) = top_ + 1, grown = true;
      }
    }
    --top_;
    for (const Tetrahedron& t : tetrahedra_)
      for (const int node : t)
        if (at(level_, node) < 0) fail(node, "a part does not hang together with the inner surface");
  }

  void find_partners() {
    for (const Tetrahedron& t : tetrahedra_)
      for (const int node : t)
        for (const int other : t)
          if (at(level_, other) == at(level_, node) + 1 &&
              (above(node) < 0 || distance(node, other) < distance(node, above(node))))
            at(above_, node) = other;
    for (int k = 0; k < top_; ++k)
      for (int node = 0; node < points_.cols(); ++node) {
        if (at(level_, node) != k) continue;
        if (above(node) < 0) fail(node, "a node has no partner in the next layer");
        if (at(column_, above(node)) >= 0) fail(node, "two nodes share their partner in the next layer");
        at(column_, above(node)) = at(column_, node);
      }
  }
  std::set<Edge> neighbouring_columns() const {
    std::set<Edge> pairs;
    const auto add = [&](int a, int b) { pairs.insert({std::min(a, b), std::max(a, b)}); };
    std::map<Edge, int> opposite;  // of an edge: the third node of its first triangle
    for (const Triangle& t : inner_)
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        add(a, b);
        const auto [edge, is_first] = opposite.emplace(Edge{std::min(a, b), std::max(a, b)}, c);
        if (!is_first) add(edge->second, c);
      }
    return pairs;
  }
  double distance(int a, int b) const { return (points_.col(a) - points_.col(b)).norm(); }

  const Points& points_;
  const std::vector<Tetrahedron>& tetrahedra_;
  const std::vector<Triangle>& inner_;
  std::string name_;
  std::vector<int> level_, column_, above_;
  int top_ = 0;  ///< the outermost layer
};

double volume(const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  double sum = 0;
  for (const Tetrahedron& t : tetrahedra) sum += std::abs(signed_volume(points, t));
  return sum;
}

}  // namespace

std::vector<Prism> recombine_prisms(const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                                    const std::vector<Triangle>& inner, const std::string& name) {
  const Layers layers(points, tetrahedra, inner, name);
  layers.verify();
  std::vector<Prism> prisms = layers.prisms();
  if (tetrahedra.size() != 3 * prisms.size())
    layers.fail(inner.front()[0], fmt::format("{} tetrahedra cannot be {} prisms", tetrahedra.size(), prisms.size()));
  const double before = volume(points, tetrahedra), after = volume(points, split_into_tetrahedra(prisms));
  if (std::abs(after - before) > 1e-3 * before)
    layers.fail(inner.front()[0], fmt::format("volume {:.8g} of the tetrahedra, {:.8g} of the prisms", before, after));
  return prisms;
}

namespace {

/// Triangles with the patch they belong to, found by nodes or by nearness.
class PatchLookup {
 public:
  PatchLookup(const Points& points, const std::vector<Patch>& patches)
      : points_(points), centres_(centres(points, patches)) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (const Triangle& t : patches[p].triangles) {
        by_nodes_[sorted(t)] = p;
        by_order_.push_back(p);
      }
  }
  std::optional<std::size_t> with_nodes(const Triangle& t) const {
    const auto found = by_nodes_.find(sorted(t));
    return found == by_nodes_.end() ? std::nullopt : std::optional(found->second);
  }
  std::size_t nearest(const Triangle& t) const {
    return by_order_[static_cast<std::size_t>(centres_.nearest(points_(Eigen::all, t).rowwise().mean()).node)];
  }

 private:
  static Points centres(const Points& points, const std::vector<Patch>& patches) {
    std::vector<Vec3> all;
    for (const Patch& patch : patches)
      for (const Triangle& t : patch.triangles) all.emplace_back(points(Eigen::all, t).rowwise().mean());
    return Points::Map(all.empty() ? nullptr : all.front().data(), 3, static_cast<Eigen::Index>(all.size()));
  }
  const Points& points_;
  PointLocator centres_;
  std::map<Triangle, std::size_t> by_nodes_;
  std::vector<std::size_t> by_order_;
};

std::vector<Triangle> outer_tops(const std::vector<Prism>& prisms) {
  std::set<Triangle> bottoms;
  for (const Prism& p : prisms) bottoms.insert(sorted({p[0], p[1], p[2]}));
  std::vector<Triangle> tops;
  for (const Prism& p : prisms)
    if (const Triangle top{p[3], p[4], p[5]}; !bottoms.contains(sorted(top))) tops.push_back(top);
  return tops;
}

}  // namespace

std::vector<Patch> carried_over(const Points& points, const std::vector<Patch>& patches,
                                const std::vector<Prism>& prisms) {
  const PatchLookup lookup(points, patches);
  std::vector<Patch> carried;
  for (const Patch& patch : patches) carried.push_back({patch.name, {}});
  if (carried.empty()) return carried;
  for (const Triangle& top : outer_tops(prisms))
    carried[lookup.with_nodes(top).value_or(lookup.nearest(top))].triangles.push_back(top);
  for (const auto& [a, b, c, d] : boundary_sides(prisms))
    for (const Triangle& corner : {Triangle{a, b, c}, {b, c, d}, {c, d, a}, {d, a, b}})
      if (const auto patch = lookup.with_nodes(corner)) {
        for (const Triangle& half : split_quadrilateral(a, b, c, d)) carried[*patch].triangles.push_back(half);
        break;
      }
  return carried;
}

}  // namespace tether
