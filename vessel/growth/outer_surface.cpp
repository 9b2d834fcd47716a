#include "vessel/growth/outer_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/placed_error.hpp"
#include "common/mesh/mesh.hpp"
#include "common/mesh/triangle_locator.hpp"
#include "vessel/growth/crossings.hpp"
#include "vessel/growth/minimise.hpp"
#include "vessel/growth/prism_shape.hpp"

namespace tether {

namespace {

// det T of a prism: below `poor` its neighbourhood is improved; below `sound` less thickness is aimed at, for the wall
// of an element so skewed gives way under its own tension (decision 101); below `folded` there must be less, or no wall
constexpr double poor = 0.3, sound = 0.2, folded = 0.1;
constexpr double thin = 0.8;             ///< of the asked thickness: below it the neighbourhood is improved
constexpr double thickness_weight = 50;  ///< an error of a tenth weighs as a prism half as good
constexpr double steepest = 0.5;         ///< the aim's change over the way, where it was made less
constexpr int rings_around = 3, most_softenings = 12;

using Marks = std::vector<char>;

Mat3 corners_of(const Points& points, const Triangle& t) {
  return points(Eigen::all, t);
}

/// The growth of one wall: what stays the same, and the state.
class Growth {
 public:
  /// least: det T that all prisms shall have.
  Growth(const GrowthBase& base, const VectorXd& asked, const GrowthSteps& steps, double least)
      : base_(base),
        asked_(asked),
        steps_(steps),
        least_(least),
        aim_(asked),
        locator_(base.points, base.triangles),
        top_(straight()),
        moved_(static_cast<std::size_t>(base.points.cols()), 0) {}

  OuterSurface grown() {
    for (int round = 0; round < steps_.most; ++round) {
      improve();
      const std::vector<int> bad = unfit();
      if (bad.empty()) return result();
      aim_lower(bad);
    }
    refuse(base_.triangles[static_cast<std::size_t>(unfit().front())][0]);
  }

 private:
  Points straight() const { return base_.points + base_.directions * aim_.asDiagonal(); }

  PrismShape shape(const Triangle& t) const {
    return {corners_of(base_.points, t), Vec3(aim_[t[0]], aim_[t[1]], aim_[t[2]])};
  }
  double worst(const Triangle& t) const { return shape(t).worst(corners_of(top_, t)); }

  double distance(int node) const { return locator_.nearest(top_.col(node)).distance; }

  /// Nodes near prisms that are poor or thin.
  std::vector<int> nodes_to_move() const {
    Marks marked(static_cast<std::size_t>(base_.points.cols()), 0);
    for (const Triangle& t : base_.triangles)
      if (worst(t) < poor || any_layer_folds(t))
        for (const int node : t) marked[static_cast<std::size_t>(node)] = 1;
    for (int node = 0; node < base_.points.cols(); ++node)
      if (distance(node) < thin * aim_[node]) marked[static_cast<std::size_t>(node)] = 1;
    for (int ring = 0; ring < rings_around; ++ring) marked = with_neighbours(marked);
    std::vector<int> nodes;
    for (std::size_t node = 0; node < marked.size(); ++node)
      if (marked[node]) nodes.push_back(static_cast<int>(node));
    return nodes;
  }

  Marks with_neighbours(const Marks& marked) const {
    Marks more = marked;
    for (const Triangle& t : base_.triangles)
      if (std::any_of(t.begin(), t.end(), [&](int node) { return marked[static_cast<std::size_t>(node)]; }))
        for (const int node : t) more[static_cast<std::size_t>(node)] = 1;
    return more;
  }

  /// Slides what is poor, with more room around it as long as it stays poor.
  void improve() {
    const std::vector<int> nodes = nodes_to_move();
    if (nodes.empty()) return;
    for (const int node : nodes) moved_[static_cast<std::size_t>(node)] = 1;
    std::vector<int> place(static_cast<std::size_t>(base_.points.cols()), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) place[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
    std::vector<Triangle> triangles;
    std::vector<PrismShape> shapes;
    for (const Triangle& t : base_.triangles)
      if (std::any_of(t.begin(), t.end(), [&](int node) { return place[static_cast<std::size_t>(node)] >= 0; }))
        triangles.push_back(t), shapes.push_back(shape(t));
    double before = -std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < most_softenings; ++pass) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < triangles.size(); ++i)
        least = std::min(least, shapes[i].worst(corners_of(top_, triangles[i])));
      if (least > 0 && least < before + 0.02) break;
      before = least;
      slide(nodes, place, triangles, shapes, std::max(1e-3, -0.2 * least));
    }
  }

  void slide(const std::vector<int>& nodes, const std::vector<int>& place, const std::vector<Triangle>& triangles,
             const std::vector<PrismShape>& shapes, double softening) {
    const auto energy = [&](const VectorXd& x, VectorXd& gradient) {
      return energy_of(x, gradient, nodes, place, triangles, shapes, softening);
    };
    const Points start = top_(Eigen::all, nodes);
    const Minimum best = minimise(energy, start.reshaped(), 60);
    top_(Eigen::all, nodes) = best.x.reshaped(3, static_cast<Eigen::Index>(nodes.size()));
  }

  double energy_of(const VectorXd& x, VectorXd& gradient, const std::vector<int>& nodes, const std::vector<int>& place,
                   const std::vector<Triangle>& triangles, const std::vector<PrismShape>& shapes, double softening) {
    top_(Eigen::all, nodes) = x.reshaped(3, static_cast<Eigen::Index>(nodes.size()));
    Points slope = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
    double sum = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      Mat3 derivative = Mat3::Zero();
      sum += shapes[i].energy(corners_of(top_, triangles[i]), softening, derivative);
      for (Eigen::Index corner = 0; corner < 3; ++corner)
        if (const int at = place[static_cast<std::size_t>(triangles[i][static_cast<std::size_t>(corner)])]; at >= 0)
          slope.col(at) += derivative.col(corner);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int node = nodes[i];
      const auto nearest = locator_.nearest(top_.col(node));
      const double error = nearest.distance / aim_[node] - 1;  // (M.3)
      sum += thickness_weight * error * error;
      if (nearest.distance > 0)
        slope.col(static_cast<Eigen::Index>(i)) +=
            2 * thickness_weight * error / aim_[node] * (top_.col(node) - nearest.place) / nearest.distance;
      const Vec3 normal = base_.planes.col(node);
      slope.col(static_cast<Eigen::Index>(i)) -= normal * normal.dot(slope.col(static_cast<Eigen::Index>(i)));
    }
    gradient = slope.reshaped();
    return sum;
  }

  /// Triangles whose prism is folded, in any layer, or whose top cuts another part of the outer surface.
  std::vector<int> unfit() const {
    std::vector<int> bad;
    for (std::size_t i = 0; i < base_.triangles.size(); ++i)
      if (worst(base_.triangles[i]) < least_ || any_layer_folds(base_.triangles[i])) bad.push_back(static_cast<int>(i));
    for (const int triangle : crossing_triangles(top_, base_.triangles)) bad.push_back(triangle);
    return bad;
  }

  bool any_layer_folds(const Triangle& t) const {
    const auto nodes = static_cast<int>(base_.points.cols());
    const Prism prism{t[0], t[1], t[2], t[0] + nodes, t[1] + nodes, t[2] + nodes};
    const Mat3 bottom = corners_of(base_.points, t), step = (corners_of(top_, t) - bottom) / base_.layers;
    for (const Tetrahedron& part : split_into_tetrahedra({prism}))
      for (int layer = 0; layer < base_.layers; ++layer) {
        Points corners(3, 4);
        for (std::size_t i = 0; i < 4; ++i) {
          const auto corner = std::find(prism.begin(), prism.end(), part[i]) - prism.begin();
          corners.col(static_cast<Eigen::Index>(i)) =
              bottom.col(corner % 3) + (layer + (corner >= 3 ? 1 : 0)) * step.col(corner % 3);
        }
        if (!(signed_volume(corners, {0, 1, 2, 3}) > 0)) return true;
      }
    return false;
  }

  void aim_lower(const std::vector<int>& bad) {
    const VectorXd before = aim_;
    Marks marked(static_cast<std::size_t>(base_.points.cols()), 0);
    for (const int triangle : bad)
      for (const int node : base_.triangles[static_cast<std::size_t>(triangle)])
        marked[static_cast<std::size_t>(node)] = 1;
    for (int node = 0; node < base_.points.cols(); ++node)
      if (marked[static_cast<std::size_t>(node)]) {
        if (steps_.left * aim_[node] < least_share * asked_[node]) refuse(node);
        aim_[node] *= steps_.left;
      }
    flatten();
    for (int node = 0; node < base_.points.cols(); ++node)
      if (aim_[node] < before[node]) {
        top_.col(node) = base_.points.col(node) + aim_[node] * base_.directions.col(node);
        moved_[static_cast<std::size_t>(node)] = 1;
      }
  }

  /// The share of what was asked changes by at most `steepest` per asked thickness.
  void flatten() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const Triangle& t : base_.triangles)
        for (std::size_t i = 0; i < 3; ++i)
          for (const int other : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
            const double way = (base_.points.col(t[i]) - base_.points.col(other)).norm();
            const double most = aim_[other] / asked_[other] * asked_[t[i]] + steepest * way;
            if (aim_[t[i]] > most * (1 + 1e-9)) aim_[t[i]] = most, changed = true;
          }
    }
  }

  OuterSurface result() const {
    OuterSurface surface{top_, asked_, VectorXd(asked_.size()), aim_, {}};
    for (int node = 0; node < asked_.size(); ++node) surface.thickness[node] = distance(node);
    surface.moved = moved_;
    return surface;
  }

  [[noreturn]] void refuse(int node) const {
    const Vec3 at = base_.points.col(node);
    throw PlacedError(
        fmt::format("a wall of thickness {:.3g} folds over itself or meets itself near ({:.4g}, {:.4g}, {:.4g}), and "
                    "so does one of {:.3g}: ask for less there (a branch may have a thickness of its own), smooth the "
                    "lumen's surface, or give it shorter edges there",
                    asked_[node], at[0], at[1], at[2], aim_[node]),
        {at});
  }

  const GrowthBase& base_;
  const VectorXd& asked_;
  GrowthSteps steps_;
  double least_;
  VectorXd aim_;
  TriangleLocator locator_;
  Points top_;
  Marks moved_;
};

}  // namespace

OuterSurface grow_outer_surface(const GrowthBase& base, const VectorXd& asked, const GrowthSteps& steps) {
  try {
    return Growth(base, asked, steps, sound).grown();
  } catch (const PlacedError&) {
    return Growth(base, asked, steps, folded).grown();
  }
}

}  // namespace tether
