#include "common/mesh/locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tether {

PointLocator::PointLocator(Points points)
    : points_(std::move(points)), order_(static_cast<std::size_t>(points_.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
  sort(0, order_.size(), 0);
}

void PointLocator::sort(std::size_t begin, std::size_t end, int axis) {
  if (end - begin < 2) return;
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](int a, int b) { return points_(axis, a) < points_(axis, b); });
  sort(begin, middle, (axis + 1) % 3);
  sort(middle + 1, end, (axis + 1) % 3);
}

PointLocator::Nearest PointLocator::nearest(const Vec3& x) const {
  Nearest best{-1, std::numeric_limits<double>::infinity()};
  search(0, order_.size(), 0, x, best);
  return best;
}

void PointLocator::search(std::size_t begin, std::size_t end, int axis, const Vec3& x, Nearest& best) const {
  if (begin == end) return;
  const std::size_t middle = (begin + end) / 2;
  const int node = order_[middle];
  const double distance = (points_.col(node) - x).norm();
  if (distance < best.distance || (distance == best.distance && node < best.node)) best = {node, distance};
  const double beyond = x[axis] - points_(axis, node);
  const int next = (axis + 1) % 3;
  beyond < 0 ? search(begin, middle, next, x, best) : search(middle + 1, end, next, x, best);
  if (std::abs(beyond) > best.distance) return;
  beyond < 0 ? search(middle + 1, end, next, x, best) : search(begin, middle, next, x, best);
}

}  // namespace tether
