#include "tests/observation_manager/shapes.hpp"

#include <Eigen/Geometry>
#include <array>
#include <map>

namespace tether::testing {

TriangleSurface cube(int n) {
  std::map<std::array<int, 3>, int> number;
  TriangleSurface surface;
  const auto node = [&](const std::array<int, 3>& place) {
    return number.emplace(place, static_cast<int>(number.size())).first->second;
  };
  const auto add = [&](std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
    surface.triangles.push_back({node(a), node(b), node(c)});
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int p, int q) {
            std::array<int, 3> place{};
            place[axis] = side, place[(axis + 1) % 3] = p, place[(axis + 2) % 3] = q;
            return place;
          };
          const auto a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side == n) {
            add(a, b, c), add(a, c, d);
          } else {
            add(a, c, b), add(a, d, c);
          }
        }
  surface.points.resize(3, static_cast<Eigen::Index>(number.size()));
  for (const auto& [place, at] : number)
    surface.points.col(at) = 2.0 / n * Vec3(place[0], place[1], place[2]) - Vec3::Ones();
  return surface;
}

}  // namespace tether::testing
