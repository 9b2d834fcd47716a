#include "vessel/anatomy/surface_places.hpp"

namespace tether {

SurfacePlaces nodes_as_places(const Points& points, const std::vector<Triangle>& triangles) {
  SurfacePlaces places{points, std::vector<int>(static_cast<std::size_t>(points.cols()), -1),
                       Points::Zero(3, points.cols())};
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const int node = triangles[t][corner];
      if (places.triangle[static_cast<std::size_t>(node)] >= 0) continue;
      places.triangle[static_cast<std::size_t>(node)] = static_cast<int>(t);
      places.barycentric.col(node) = Vec3::Unit(static_cast<Eigen::Index>(corner));
    }
  return places;
}

RefinedTriangles refined(const Points& points, const std::vector<Triangle>& triangles, const std::vector<int>& chosen,
                         int pieces) {
  std::vector<Vec3> pattern;  // row j has pieces + 1 - j places
  const auto number = [&](int i, int j) { return j * (pieces + 1) - j * (j - 1) / 2 + i; };
  for (int j = 0; j <= pieces; ++j)
    for (int i = 0; i + j <= pieces; ++i) pattern.push_back(Vec3(pieces - i - j, i, j) / pieces);
  const auto each = static_cast<Eigen::Index>(pattern.size()), count = static_cast<Eigen::Index>(chosen.size());
  RefinedTriangles fine{{Points(3, each * count), {}, Points(3, each * count)}, {}, pieces * pieces};
  for (Eigen::Index t = 0; t < count; ++t) {
    const int triangle = chosen[static_cast<std::size_t>(t)];
    for (Eigen::Index i = 0; i < each; ++i) {
      const Vec3& weights = pattern[static_cast<std::size_t>(i)];
      fine.places.barycentric.col(t * each + i) = weights;
      fine.places.points.col(t * each + i) =
          points(Eigen::all, triangles[static_cast<std::size_t>(triangle)]) * weights;
      fine.places.triangle.push_back(triangle);
    }
    const int first = static_cast<int>(t * each);
    for (int j = 0; j < pieces; ++j)
      for (int i = 0; i + j < pieces; ++i) {
        fine.parts.push_back({first + number(i, j), first + number(i + 1, j), first + number(i, j + 1)});
        if (i + j + 1 < pieces)
          fine.parts.push_back({first + number(i + 1, j), first + number(i + 1, j + 1), first + number(i, j + 1)});
      }
  }
  return fine;
}

}  // namespace tether
