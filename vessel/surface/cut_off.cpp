#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "vessel/surface/edges.hpp"
#include "vessel/surface/rims.hpp"

namespace tether {
namespace {

PlacedError wrong_plane(const Plane& plane, const char* what) {
  return {fmt::format("the plane at {} {}", text_of_place(plane.origin), what), {plane.origin}};
}

/// Where a plane meets a surface.
class Cut {
 public:
  Cut(RawSurface& surface, const Plane& plane) : surface_(surface), plane_(plane), edges_(edges_of(surface.triangles)) {
    height_ = plane.normal.transpose() * (surface.points.colwise() - plane.origin);
    // no node on the plane: a cut through a node would make triangles without area
    const double least = 1e-7 * (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).norm();
    height_ = height_.unaryExpr([least](double h) { return std::abs(h) < least ? least : h; });
  }

  void take_off_beyond() {
    const std::set<int> ring = nearest_ring();
    split(ring);
    drop_beyond();
  }

 private:
  bool crosses(const Edge& e) const { return (height_[e.first] > 0) != (height_[e.second] > 0); }
  bool crosses(const Triangle& t) const { return crosses(Edge{t[0], t[1]}) || crosses(Edge{t[1], t[2]}); }
  Vec3 crossing(const Edge& e) const {
    const double s = height_[e.first] / (height_[e.first] - height_[e.second]);
    return surface_.points.col(e.first) + s * (surface_.points.col(e.second) - surface_.points.col(e.first));
  }

  std::set<int> ring_from(int start, std::set<int>& seen) const {
    std::set<int> ring{start};
    for (std::vector<int> open{start}; !open.empty();) {
      const Triangle t = surface_.triangles[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge = edge_of(t[i], t[(i + 1) % 3]);
        if (!crosses(edge)) continue;
        for (const EdgeUse& use : edges_.at(edge))
          if (ring.insert(use.triangle).second) open.push_back(use.triangle);
      }
    }
    seen.insert(ring.begin(), ring.end());
    return ring;
  }

  /// From the plane's origin to the middle of a ring of crossed triangles.
  double distance(const std::set<int>& ring) const {
    Vec3 sum = Vec3::Zero();
    for (const int t : ring) sum += middle(surface_, static_cast<std::size_t>(t));
    return (sum / static_cast<double>(ring.size()) - plane_.origin).norm();
  }

  std::set<int> nearest_ring() const {
    std::set<int> seen, nearest;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      if (!crosses(surface_.triangles[t]) || seen.contains(static_cast<int>(t))) continue;
      std::set<int> ring = ring_from(static_cast<int>(t), seen);
      if (nearest.empty() || distance(ring) < distance(nearest)) nearest = std::move(ring);
    }
    if (nearest.empty()) throw wrong_plane(plane_, "does not meet the surface");
    return nearest;
  }

  int node_at(const Edge& edge) {
    const auto [at, is_new] =
        new_nodes_.emplace(edge, static_cast<int>(surface_.points.cols() + static_cast<Eigen::Index>(added_.size())));
    if (is_new) added_.push_back(crossing(edge));
    return at->second;
  }

  void add(const Triangle& t, int id, int side) {
    surface_.triangles.push_back(t);
    surface_.face_id.push_back(id);
    side_.push_back(side);
  }

  void split(const std::set<int>& ring) {
    const std::vector<Triangle> old = std::move(surface_.triangles);
    const std::vector<int> ids = std::move(surface_.face_id);
    surface_.triangles.clear(), surface_.face_id.clear();
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (!ring.contains(static_cast<int>(k))) {
        add(old[k], ids[k], 0);
        continue;
      }
      Triangle t = old[k];  // turned until its first node is alone on its side
      while ((height_[t[0]] > 0) == (height_[t[1]] > 0) || (height_[t[0]] > 0) == (height_[t[2]] > 0))
        std::rotate(t.begin(), t.begin() + 1, t.end());
      const int a = node_at(edge_of(t[0], t[1])), b = node_at(edge_of(t[0], t[2]));
      const int side = height_[t[0]] > 0 ? 1 : -1;
      add({t[0], a, b}, ids[k], side);
      add({a, t[1], t[2]}, ids[k], -side);
      add({a, t[2], b}, ids[k], -side);
    }
    const Eigen::Index before = surface_.points.cols();
    surface_.points.conservativeResize(3, before + static_cast<Eigen::Index>(added_.size()));
    for (std::size_t i = 0; i < added_.size(); ++i)
      surface_.points.col(before + static_cast<Eigen::Index>(i)) = added_[i];
    first_new_ = static_cast<int>(before);
  }

  void drop_beyond() {
    const EdgeUses edges = edges_of(surface_.triangles);
    std::vector<int> open;
    for (std::size_t t = 0; t < side_.size(); ++t)
      if (side_[t] > 0) open.push_back(static_cast<int>(t));
    while (!open.empty()) {
      const Triangle t = surface_.triangles[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge = edge_of(t[i], t[(i + 1) % 3]);
        if (edge.first >= first_new_) continue;  // of the cut itself
        for (const EdgeUse& use : edges.at(edge)) {
          if (side_[use.triangle] < 0)
            throw wrong_plane(plane_, "does not cut anything off: the surface goes round it");
          if (side_[use.triangle] == 0) side_[use.triangle] = 1, open.push_back(use.triangle);
        }
      }
    }
    std::vector<bool> keep(side_.size());
    std::transform(side_.begin(), side_.end(), keep.begin(), [](int side) { return side <= 0; });
    surface_ = kept(surface_, keep);
  }

  RawSurface& surface_;
  const Plane& plane_;
  EdgeUses edges_;
  Eigen::RowVectorXd height_;  ///< of the nodes above the plane
  std::map<Edge, int> new_nodes_;
  std::vector<Vec3> added_;
  std::vector<int> side_;  ///< 1 beyond, -1 before, 0 not known yet
  int first_new_ = 0;
};

}  // namespace

void cut_off(RawSurface& surface, const Plane& outward) {
  Cut(surface, outward).take_off_beyond();
}

}  // namespace tether
