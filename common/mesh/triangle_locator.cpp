#include "common/mesh/triangle_locator.hpp"

#include <algorithm>
#include <numeric>

#include "common/mesh/surface.hpp"

namespace tether {

namespace {

constexpr int leaf_size = 4;

double squared_distance(const Vec3& x, const Vec3& low, const Vec3& high) {
  return (low - x).cwiseMax(x - high).cwiseMax(0).squaredNorm();
}

}  // namespace

TriangleLocator::TriangleLocator(Points points, std::vector<Triangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

int TriangleLocator::build(int begin, int end) {
  const double far = std::numeric_limits<double>::infinity();
  Box box{Vec3::Constant(far), Vec3::Constant(-far), begin, end};
  for (int i = begin; i < end; ++i)
    for (const int node : at(i)) {
      box.low = box.low.cwiseMin(points_.col(node));
      box.high = box.high.cwiseMax(points_.col(node));
    }
  const int number = static_cast<int>(boxes_.size());
  boxes_.push_back(box);
  if (end - begin <= leaf_size) return number;
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  const auto height = [&](int triangle) {
    const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
    return points_(axis, t[0]) + points_(axis, t[1]) + points_(axis, t[2]);
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return std::pair(height(a), a) < std::pair(height(b), b); });
  const int left = build(begin, middle), right = build(middle, end);
  boxes_[static_cast<std::size_t>(number)].left = left;
  boxes_[static_cast<std::size_t>(number)].right = right;
  return number;
}

TriangleLocator::Nearest TriangleLocator::nearest(const Vec3& x) const {
  Nearest best;
  if (!boxes_.empty()) search(0, x, best);
  return best;
}

void TriangleLocator::search(int number, const Vec3& x, Nearest& best) const {
  const Box& box = boxes_[static_cast<std::size_t>(number)];
  if (squared_distance(x, box.low, box.high) >= best.distance * best.distance) return;
  if (box.left >= 0) {
    const Box &left = boxes_[static_cast<std::size_t>(box.left)], &right = boxes_[static_cast<std::size_t>(box.right)];
    const bool left_first = squared_distance(x, left.low, left.high) <= squared_distance(x, right.low, right.high);
    search(left_first ? box.left : box.right, x, best);
    search(left_first ? box.right : box.left, x, best);
    return;
  }
  for (int i = box.begin; i < box.end; ++i) {
    const Triangle& t = at(i);
    const Vec3 weights = closest_in_triangle(x, points_.col(t[0]), points_.col(t[1]), points_.col(t[2]));
    const Vec3 place = points_(Eigen::all, t) * weights;
    if (const double distance = (place - x).norm(); distance < best.distance)
      best = {order_[static_cast<std::size_t>(i)], weights, place, distance};
  }
}

void TriangleLocator::overlapping(const Vec3& low, const Vec3& high, const std::function<void(int)>& found) const {
  std::vector<int> open;
  if (!boxes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Box& box = boxes_[static_cast<std::size_t>(open.back())];
    open.pop_back();
    if ((box.low.array() > high.array()).any() || (box.high.array() < low.array()).any()) continue;
    if (box.left >= 0) {
      open.push_back(box.left), open.push_back(box.right);
      continue;
    }
    for (int i = box.begin; i < box.end; ++i) {
      const auto corners = points_(Eigen::all, at(i));
      const Vec3 lowest = corners.rowwise().minCoeff(), highest = corners.rowwise().maxCoeff();
      if ((lowest.array() <= high.array()).all() && (highest.array() >= low.array()).all())
        found(order_[static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace tether
