#include "vessel/centreline/find_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>

#include "common/mesh/surface.hpp"
#include "vessel/centreline/curve.hpp"
#include "vessel/centreline/voronoi.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {
namespace {

struct Opening {
  Vec3 centre, outward;
  double radius;
};

Opening opening_of(const LabelledSurface& surface, int index) {
  std::vector<Triangle> cap;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.label[t] == index + 1) cap.push_back(surface.triangles[t]);
  return {centroid(surface.points, cap), total_area_vector(surface.points, cap).normalized(),
          std::sqrt(total_area(surface.points, cap) / std::numbers::pi)};
}

/// The centre where the vessel's line meets an opening: among those near it, the one of the largest sphere.
int centre_at(const VoronoiGraph& graph, const Opening& opening, const std::string& name) {
  int best = -1;
  double best_cost = 0;
  for (std::size_t i = 0; i < graph.centres.size(); ++i) {
    const double distance = (graph.centres[i] - opening.centre).norm();
    if (distance > opening.radius) continue;
    const double cost = distance - graph.radii[i];
    if (best < 0 || cost < best_cost) best = static_cast<int>(i), best_cost = cost;
  }
  if (best < 0)
    throw PlacedError(
        fmt::format("no centreline begins at opening '{}' at {}: its triangles are too large or too long there: "
                    "give a surface with smaller ones",
                    name, text_of_place(opening.centre)),
        {opening.centre});
  return best;
}

/// The cheapest way from `start` to any of `ends`; empty if there is none.
std::vector<int> cheapest_way(const VoronoiGraph& graph, int start, const std::vector<bool>& ends) {
  std::vector<double> cost(graph.centres.size(), std::numeric_limits<double>::infinity());
  std::vector<int> before(graph.centres.size(), -1);
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  open.emplace(cost[start] = 0, start);
  while (!open.empty()) {
    const auto [now, at] = open.top();
    open.pop();
    if (now > cost[at]) continue;
    if (ends[at]) {
      std::vector<int> way;
      for (int node = at; node >= 0; node = before[node]) way.push_back(node);
      return way;  // from the end back to the start
    }
    for (const auto& link : graph.links[at])
      if (now + link.cost < cost[link.to]) {
        before[link.to] = at;
        open.emplace(cost[link.to] = now + link.cost, link.to);
      }
  }
  return {};
}

constexpr double smoothing_width = 0.25;  // of the radius: shifts a line of curvature radius 3 r by a hundredth of r

class TreeFinder {
 public:
  TreeFinder(const LabelledSurface& surface, double spacing)
      : surface_(surface),
        spacing_(spacing),
        graph_(voronoi_graph(surface)),
        distance_(surface),
        line_of_(graph_.centres.size(), -1) {}

  void add(int opening, int target) {
    const Opening from = opening_of(surface_, opening);
    const std::string& name = surface_.openings[opening];
    const int start = centre_at(graph_, from, name);
    std::vector<bool> ends(graph_.centres.size(), false);
    Opening inlet{};
    if (target >= 0) {
      inlet = opening_of(surface_, target);
      ends[centre_at(graph_, inlet, surface_.openings[target])] = true;
    } else {
      for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = line_of_[i] >= 0;
    }
    const std::vector<int> way = cheapest_way(graph_, start, ends);
    if (way.empty())
      throw PlacedError(
          fmt::format("no way leads from opening '{}' at {} to the others", name, text_of_place(from.centre)),
          {from.centre});
    const int parent = line_of_[way.front()];
    Branch branch{name, parent, {}, {}};
    Polyline line;
    if (target >= 0)
      line.push_back(inlet.centre);
    else
      line.push_back(nearest_on(tree_.branches[parent].points, graph_.centres[way.front()]).point);
    for (const int node : way) line.push_back(graph_.centres[node]);
    line.push_back(from.centre);
    branch.points = finished(drop_overshoot(std::move(line), from, target >= 0 ? &inlet : nullptr));
    for (const Vec3& x : branch.points) branch.radii.push_back(distance_(x));
    const auto number = static_cast<int>(tree_.branches.size());
    for (const int node : way)
      if (line_of_[node] < 0) line_of_[node] = number;
    tree_.branches.push_back(std::move(branch));
  }

  CentrelineTree take() { return std::move(tree_); }

 private:
  /// Without points that lie nearer to an end's plane than a tenth of its radius, other than the end itself.
  static Polyline drop_overshoot(Polyline line, const Opening& last, const Opening* first) {
    const auto too_near = [](const Vec3& x, const Opening& o) {
      return (x - o.centre).norm() < 2 * o.radius && (x - o.centre).dot(o.outward) > -0.1 * o.radius;
    };
    Polyline result{line.front()};
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      if (!too_near(line[i], last) && !(first && too_near(line[i], *first))) result.push_back(line[i]);
    result.push_back(line.back());
    return result;
  }

  Polyline finished(const Polyline& way) const {
    const Polyline fine = resampled(way, spacing_ / 4);
    double mean_radius = 0;
    for (const Vec3& x : fine) mean_radius += distance_(x) / static_cast<double>(fine.size());
    return resampled(smoothed(fine, smoothing_width * mean_radius), spacing_);
  }

  const LabelledSurface& surface_;
  double spacing_;
  VoronoiGraph graph_;
  WallDistance distance_;
  std::vector<int> line_of_;  ///< per centre: the branch on whose way it lies, -1 none
  CentrelineTree tree_;
};

}  // namespace

CentrelineTree find_tree(const LabelledSurface& surface, int trunk_outlet, double spacing) {
  TreeFinder finder(surface, spacing);
  finder.add(trunk_outlet, surface.inlet);
  std::vector<std::pair<double, int>> others;
  for (int i = 0; i < static_cast<int>(surface.openings.size()); ++i)
    if (i != trunk_outlet && i != surface.inlet) others.emplace_back(-opening_of(surface, i).radius, i);
  std::sort(others.begin(), others.end());
  for (const auto& [size, opening] : others) finder.add(opening, -1);
  return finder.take();
}

}  // namespace tether
