#include "vessel/anatomy/cut.hpp"

#include <algorithm>

namespace tether {

namespace {

constexpr double sliver = 1e-9;  ///< of a triangle's area

double share_of(const std::vector<TrianglePart>& parts) {
  double sum = 0;
  for (const TrianglePart& part : parts) sum += part.share();
  return sum;
}

}  // namespace

Polygon whole_triangle() {
  return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}

Halves split(const Polygon& polygon, const Border& border) {
  const auto any = [&](double sign) {
    return std::any_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& x) { return sign * border.beyond(x) > border.tolerance; });
  };
  if (!any(1)) return {polygon, {}};
  if (!any(-1)) return {{}, polygon};
  Halves halves;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = border.beyond(a), at_b = border.beyond(b);
    if (at_a <= 0) halves.less.push_back(a);
    if (at_a >= 0) halves.more.push_back(a);
    if (at_a * at_b >= 0) continue;
    const Vec3 between = (at_b * a - at_a * b) / (at_b - at_a);
    halves.less.push_back(between), halves.more.push_back(between);
  }
  return halves;
}

Polygons taken(Polygons& left, const std::vector<Side>& sides) {
  Polygons inside, outside;
  for (Polygon polygon : left) {
    for (const Side& side : sides) {
      if (polygon.empty()) break;
      Halves halves = split(polygon, side.border);
      polygon = side.inside_is_less ? halves.less : halves.more;
      Polygon& other = side.inside_is_less ? halves.more : halves.less;
      if (!other.empty()) outside.push_back(std::move(other));
    }
    if (!polygon.empty()) inside.push_back(std::move(polygon));
  }
  left = std::move(outside);
  return inside;
}

std::vector<TrianglePart> triangulated(const Polygon& polygon, const Triangle& of) {
  std::vector<TrianglePart> parts;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    TrianglePart part{of};
    part.corners << polygon[0], polygon[i], polygon[i + 1];
    if (part.share() > sliver) parts.push_back(part);
  }
  return parts;
}

SharedPatches::SharedPatches(const std::vector<std::string>& names) {
  for (const std::string& name : names) patches_.push_back({name, {}});
}

void SharedPatches::add(const Triangle& triangle, const std::vector<std::vector<TrianglePart>>& shares) {
  const auto most = std::max_element(shares.begin(), shares.end(),
                                     [](const auto& a, const auto& b) { return share_of(a) < share_of(b); });
  any_cut_ |= share_of(*most) < 1;
  patches_[static_cast<std::size_t>(most - shares.begin())].triangles.push_back(triangle);
  for (std::size_t i = 0; i < patches_.size(); ++i)
    patches_[i].parts.insert(patches_[i].parts.end(), shares[i].begin(), shares[i].end());
}

std::vector<Patch> SharedPatches::finished() {
  if (!any_cut_)
    for (Patch& patch : patches_) patch.parts.clear();
  return std::move(patches_);
}

}  // namespace tether
