#include "tests/vessel/anatomies/bifurcation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/mesh/surface.hpp"
#include "tests/vessel/anatomies/remesh.hpp"

namespace tether {
namespace {

using B = Bifurcation;

double outside(const Vec3& x) {
  const double trunk = std::hypot(x[0], x[1]) - B::trunk_radius;
  if (x[0] < 0) return trunk;
  return std::min(trunk, std::hypot(x[1], x[2] - B::branch_height) - B::branch_radius);
}

/// Where the sides of a grid's tetrahedra pass through the surface: six to a cube, all with its diagonal.
class Marching {
 public:
  explicit Marching(double spacing) : low_(-1.63, -1.61, 0), high_(B::branch_end, 1.61, B::length) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      count_[i] = static_cast<int>(std::ceil((high_[i] - low_[i]) / spacing));
      step_[i] = (high_[i] - low_[i]) / count_[i];
    }
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (int i = 0; i < count_[0]; ++i)
      for (int j = 0; j < count_[1]; ++j)
        for (int k = 0; k < count_[2]; ++k)
          for (const auto& order : orders) {
            std::array<Eigen::Vector3i, 4> corners;
            corners[0] = {i, j, k};
            for (std::size_t c = 0; c < 3; ++c) corners[c + 1] = corners[c] + Eigen::Vector3i::Unit(order[c]);
            cut(corners);
          }
  }

  LabelledSurface surface() const {
    LabelledSurface result;
    result.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) result.points.col(static_cast<Eigen::Index>(i)) = points_[i];
    result.triangles = triangles_;
    result.label.assign(triangles_.size(), 0);
    return result;
  }

 private:
  Vec3 place(const Eigen::Vector3i& at) const { return low_ + step_.cwiseProduct(at.cast<double>()); }
  double value(const Eigen::Vector3i& at) const {
    const double v = outside(place(at));
    return std::abs(v) < 1e-9 ? 1e-9 : v;
  }
  int number(const Eigen::Vector3i& at) const { return (at[2] * (count_[1] + 1) + at[1]) * (count_[0] + 1) + at[0]; }

  int node(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    const auto [known, is_new] =
        nodes_.try_emplace(std::minmax({number(a), number(b)}), static_cast<int>(points_.size()));
    if (is_new) points_.push_back((value(b) * place(a) - value(a) * place(b)) / (value(b) - value(a)));
    return known->second;
  }

  void add(int a, int b, int c, const Vec3& inner) {
    const auto at = [&](int i) { return points_[static_cast<std::size_t>(i)]; };
    const bool outward = (at(b) - at(a)).cross(at(c) - at(a)).dot(at(a) - inner) > 0;
    triangles_.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
  }

  void cut(const std::array<Eigen::Vector3i, 4>& corners) {
    std::vector<Eigen::Vector3i> in, out;
    for (const auto& corner : corners) (value(corner) < 0 ? in : out).push_back(corner);
    if (in.size() == 1) add(node(in[0], out[0]), node(in[0], out[1]), node(in[0], out[2]), place(in[0]));
    if (in.size() == 3) add(node(in[0], out[0]), node(in[1], out[0]), node(in[2], out[0]), place(in[0]));
    if (in.size() != 2) return;
    const int a = node(in[0], out[0]), b = node(in[0], out[1]), c = node(in[1], out[1]), d = node(in[1], out[0]);
    add(a, b, c, place(in[0]));
    add(a, c, d, place(in[0]));
  }

  Vec3 low_, high_, step_ = Vec3::Zero();
  Eigen::Vector3i count_ = Eigen::Vector3i::Zero();
  std::map<std::pair<int, int>, int> nodes_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
};

/// Brought to the analytic surface, in the plane of an end where it lies in one.
Vec3 projected(Vec3 x) {
  const bool flat_z = x[2] < 1e-9 || x[2] > B::length - 1e-9, flat_x = x[0] > B::branch_end - 1e-9;
  for (int pass = 0; pass < 20; ++pass) {
    Vec3 slope;
    for (Eigen::Index i = 0; i < 3; ++i)
      slope[i] = (outside(x + 1e-6 * Vec3::Unit(i)) - outside(x - 1e-6 * Vec3::Unit(i))) / 2e-6;
    if (flat_z) slope[2] = 0;
    if (flat_x) slope[0] = 0;
    x -= outside(x) * slope / std::max(slope.squaredNorm(), 0.1);
  }
  return x;
}

template <class Place>
TubeSurface grid_surface(int around, int along, bool closed, Place place) {
  TubeSurface surface;
  const int levels = closed ? along : along + 1;
  surface.points.resize(3, around * levels);
  for (int i = 0; i < levels; ++i)
    for (int j = 0; j < around; ++j) {
      // an irregular pattern: every third node off its place, except at the ends
      const double shift = (i + 2 * j) % 3 == 0 && (closed || (i > 0 && i < along)) ? 0.2 : 0;
      surface.points.col(i * around + j) = place((i + shift) / along, (j + shift) / around * 2 * std::numbers::pi);
    }
  const auto node = [&](int i, int j) { return (i % levels) * around + j % around; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      surface.triangles.push_back({node(i, j), node(i, j + 1), node(i + 1, j + 1)});
      surface.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i + 1, j)});
    }
  return surface;
}

}  // namespace

Bifurcation bifurcation(double edge) {
  const LabelledSurface surface = remeshed(Marching(0.6 * edge).surface(), edge);
  Bifurcation result{surface.points, surface.triangles, {}};
  for (auto x : result.points.colwise()) x = projected(x);
  result.tree.branches = {
      {"trunk", -1, {{0, 0, 0}, {0, 0, 2}, {0, 0, 4}, {0, 0, B::length}}, std::vector<double>(4, B::trunk_radius)},
      {"branch",
       0,
       {{0, 0, B::branch_height}, {B::trunk_radius, 0, B::branch_height}, {B::branch_end, 0, B::branch_height}},
       {B::trunk_radius, B::branch_radius, B::branch_radius}}};
  return result;
}

TubeSurface tube_surface(double radius, double length, int around, int along, const Vec3& at) {
  return grid_surface(around, along, false, [&](double share, double angle) {
    return Vec3(at + Vec3(radius * std::cos(angle), radius * std::sin(angle), share * length));
  });
}

TubeSurface torus_surface(double large, double small, int around, int along) {
  return grid_surface(around, along, true, [&](double share, double angle) {
    const double turn = 2 * std::numbers::pi * share, arm = large + small * std::cos(angle);
    return Vec3(arm * std::cos(turn), -arm * std::sin(turn), small * std::sin(angle));
  });
}

TubeSurface together(const TubeSurface& one, const TubeSurface& other) {
  TubeSurface both{Points(3, one.points.cols() + other.points.cols()), one.triangles};
  both.points << one.points, other.points;
  const int first = static_cast<int>(one.points.cols());
  for (const Triangle& t : other.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return both;
}

}  // namespace tether
