#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Finds the nearest place on a triangulated surface, and triangles near a box: a tree of boxes over a copy of it.
class TriangleLocator {
 public:
  TriangleLocator(Points points, std::vector<Triangle> triangles);

  struct Nearest {
    int triangle = -1;
    Vec3 barycentric = Vec3::Zero(), place = Vec3::Zero();
    double distance = std::numeric_limits<double>::infinity();  ///< [length]
  };
  /// triangle is -1 if there is none.
  Nearest nearest(const Vec3& x) const;

  /// Calls `found` with each triangle whose box overlaps that from `low` to `high`.
  void overlapping(const Vec3& low, const Vec3& high, const std::function<void(int triangle)>& found) const;

  const Points& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  struct Box {
    Vec3 low, high;
    int begin, end;  ///< of order_; a leaf has no children
    int left = -1, right = -1;
  };
  int build(int begin, int end);
  void search(int box, const Vec3& x, Nearest& best) const;
  const Triangle& at(int place) const {
    return triangles_[static_cast<std::size_t>(order_[static_cast<std::size_t>(place)])];
  }

  Points points_;
  std::vector<Triangle> triangles_;
  std::vector<int> order_;
  std::vector<Box> boxes_;  ///< the first holds all
};

}  // namespace tether
