#include "solid/element_places.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "common/mesh/locator.hpp"
#include "solid/vessel_direction.hpp"

namespace tether {
namespace {

Points points_of(const std::vector<Vec3>& list) {
  return Eigen::Map<const Points>(list.front().data(), 3, static_cast<Eigen::Index>(list.size()));
}

template <std::size_t nodes>
Vec3 centre_of(const Points& x, const std::array<int, nodes>& cell) {
  Vec3 sum = Vec3::Zero();
  for (const int node : cell) sum += x.col(node);
  return sum / static_cast<double>(nodes);
}

/// What the zones have of each triangle.
std::map<Triangle, std::vector<double>> shares_of(const std::vector<Patch>& zones) {
  std::map<Triangle, std::vector<double>> shares;
  for (std::size_t zone = 0; zone < zones.size(); ++zone)
    for (const TrianglePart& part : parts_of(zones[zone])) {
      std::vector<double>& of = shares[part.of];
      of.resize(zones.size());
      of[zone] += part.share();
    }
  return shares;
}

/// The triangles of the outer wall, and where they are.
class OuterWall {
 public:
  OuterWall(const WallMesh& mesh, const std::vector<Patch>& zones, const VectorXd& along) {
    std::vector<Vec3> centres;
    for (const auto& [t, shares] : shares_of(zones)) {
      Mat3 x;
      x << mesh.points.col(t[0]), mesh.points.col(t[1]), mesh.points.col(t[2]);
      const Vec3 outward = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
      const Vec3 axial = along.size() == 0 ? Vec3::Zero() : direction_on(x, {along[t[0]], along[t[1]], along[t[2]]});
      places_.push_back({number_of(shares), outward, axial});
      centres.push_back(x.rowwise().mean());
    }
    locator_.emplace(points_of(centres));
  }
  const ElementPlace& near(const Vec3& x) const { return places_[static_cast<std::size_t>(locator_->nearest(x).node)]; }
  const std::vector<std::vector<double>>& mixtures() const { return mixtures_; }

 private:
  /// Of a zone, or beyond these of a mixture.
  int number_of(const std::vector<double>& shares) {
    constexpr double rounding = 1e-9;
    const auto most = std::max_element(shares.begin(), shares.end());
    if (*most > 1 - rounding) return static_cast<int>(most - shares.begin());
    mixtures_.push_back(shares);
    return static_cast<int>(shares.size() + mixtures_.size()) - 1;
  }

  std::vector<ElementPlace> places_;
  std::vector<std::vector<double>> mixtures_;
  std::optional<PointLocator> locator_;
};

}  // namespace

ElementPlaces element_places(const WallMesh& mesh, const std::vector<Patch>& zones, const VectorXd& along) {
  const OuterWall outside(mesh, zones, along);
  ElementPlaces result{{}, outside.mixtures()};
  for (const Prism& cell : mesh.prisms) result.of_elements.push_back(outside.near(centre_of(mesh.points, cell)));
  for (const Tetrahedron& cell : mesh.tetrahedra)
    result.of_elements.push_back(outside.near(centre_of(mesh.points, cell)));
  return result;
}

}  // namespace tether
