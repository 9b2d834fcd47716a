#include "common/mesh/patch.hpp"

#include "common/mesh/surface.hpp"

namespace tether {

std::vector<TrianglePart> parts_of(const Patch& patch) {
  if (!patch.parts.empty()) return patch.parts;
  std::vector<TrianglePart> whole;
  for (const Triangle& t : patch.triangles) whole.push_back({t});
  return whole;
}

double area_of(const Points& points, const Patch& patch) {
  double sum = 0;
  for (const TrianglePart& part : parts_of(patch)) sum += part.share() * area_vector(points, part.of).norm();
  return sum;
}

}  // namespace tether
