#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Finds the nearest of many points (a k-d tree over a copy of them).
class PointLocator {
 public:
  explicit PointLocator(Points points);

  struct Nearest {
    int node = -1;
    double distance = 0;  ///< [length]
  };
  /// Equal distances: the smallest node. node is -1 if there are no points.
  Nearest nearest(const Vec3& x) const;

 private:
  void sort(std::size_t begin, std::size_t end, int axis);
  void search(std::size_t begin, std::size_t end, int axis, const Vec3& x, Nearest& best) const;

  Points points_;
  std::vector<int> order_;  ///< the middle of every range splits it
};

}  // namespace tether
