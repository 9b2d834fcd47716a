#include "fsi_master/transfer/mortar_space.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

namespace tether {
namespace {

std::vector<std::vector<int>> neighbours_of(const InterfaceSurface& surface) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(surface.points.cols()));
  for (const Triangle& t : surface.triangles)
    for (const int a : t)
      for (const int b : t)
        if (a != b) neighbours[static_cast<std::size_t>(a)].push_back(b);
  for (auto& some : neighbours) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  }
  return neighbours;
}

/// Shares of places, their sum 1, that give `x` each linear field along the plane of `normal`; the least ones that do.
/// Equal ones where places on a line hold no such field.
VectorXd linear_shares(const Points& places, const Vec3& x, const Vec3& normal) {
  const Vec3 first = normal.unitOrthogonal(), second = normal.cross(first);
  const Points ways = places.colwise() - x;
  const double size = ways.colwise().norm().maxCoeff();
  MatrixXd fields(3, places.cols());
  fields << Eigen::RowVectorXd::Ones(places.cols()), first.transpose() * ways / size, second.transpose() * ways / size;
  const Vec3 wanted(1, 0, 0);
  VectorXd shares = fields.completeOrthogonalDecomposition().solve(wanted);
  if ((fields * shares - wanted).norm() > 1e-8 || shares.cwiseAbs().maxCoeff() > 4)
    shares.setConstant(1.0 / static_cast<double>(places.cols()));
  return shares;
}

}  // namespace

MortarSpace::MortarSpace(const InterfaceSurface& fluid)
    : fluid_(fluid), number_(static_cast<std::size_t>(fluid.points.cols()), 0), at_(number_.size()) {
  for (const Edge& edge : open_edges(fluid.triangles))
    for (const int node : edge) number_[static_cast<std::size_t>(node)] = -1;
  for (std::size_t a = 0; a < number_.size(); ++a)
    if (number_[a] == 0) number_[a] = static_cast<int>(solved_.size()), solved_.push_back(static_cast<int>(a));
  const std::vector<std::vector<int>> neighbours = neighbours_of(fluid);
  const Points normals = nodal_normals(fluid.points, fluid.triangles);
  for (std::size_t a = 0; a < number_.size(); ++a)
    if (number_[a] >= 0)
      at_[a] = {{static_cast<int>(a), 1.0}};
    else
      at_[a] = carried_to(static_cast<int>(a), neighbours, normals);
}

std::vector<MortarSpace::Share> MortarSpace::carried_to(int rim_node, const std::vector<std::vector<int>>& neighbours,
                                                        const Points& normals) const {
  constexpr std::size_t enough = 4;  // for a linear field along the surface, and one to choose
  std::vector<int> reached{rim_node}, inner;
  for (int ring = 0; ring < 4 && inner.size() < enough; ++ring)
    for (std::size_t known = reached.size(), i = 0; i < known; ++i)
      for (const int node : neighbours[static_cast<std::size_t>(reached[i])]) {
        if (std::find(reached.begin(), reached.end(), node) != reached.end()) continue;
        reached.push_back(node);
        if (!is_rim(node)) inner.push_back(node);
      }
  if (inner.empty()) return {};
  const VectorXd shares =
      linear_shares(fluid_.points(Eigen::all, inner), fluid_.points.col(rim_node), normals.col(rim_node));
  std::vector<Share> carried;
  for (std::size_t i = 0; i < inner.size(); ++i) carried.push_back({inner[i], shares(static_cast<Eigen::Index>(i))});
  return carried;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> MortarSpace::tests() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < at_.size(); ++a)
    for (const auto& [test, value] : at_[a])
      for (int i = 0; i < 3; ++i) entries.emplace_back(3 * test + i, 3 * static_cast<int>(a) + i, value);
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(fluid_.points.size(), fluid_.points.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<double> MortarSpace::mass() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& t : fluid_.triangles) {
    const double area = area_vector(fluid_.points, t).norm();
    for (const int a : t)
      for (const auto& [test, value] : at_[static_cast<std::size_t>(a)])
        for (const int b : t)
          if (const int column = number_[static_cast<std::size_t>(b)]; column >= 0)
            entries.emplace_back(number_[static_cast<std::size_t>(test)], column, value * area / (a == b ? 6 : 12));
  }
  const auto size = static_cast<Eigen::Index>(solved_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace tether
