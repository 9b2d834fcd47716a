#include <Eigen/LU>

#include <cmath>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "fsi_master/transfer/followed_place.hpp"
#include "fsi_master/transfer/interface_map.hpp"
#include "fsi_master/transfer/mortar_space.hpp"
#include "fsi_master/transfer/overlap.hpp"

/// How interfaces of two triangulations follow each other: what of a solid's motion a fluid node takes.
namespace tether {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

/// Throws InputError if a surface has no triangles, or one without area.
void check_triangles(const char* whose, const InterfaceSurface& surface) {
  if (surface.triangles.empty())
    throw input_error("the {} announces no interface triangles, and its nodes do not match the other's", whose);
  for (const Triangle& t : surface.triangles)
    if (!(area_vector(surface.points, t).norm() > 0))
      throw input_error("the {}'s interface triangle of nodes {}, {}, {} has no area", whose, t[0], t[1], t[2]);
}

TriangleLocator locator_of(const InterfaceSurface& solid) {
  check_triangles("wall", solid);
  return {solid.points, solid.triangles};
}

[[noreturn]] void refuse(int node, const Vec3& x, double distance, double trust, const UnitSystem& units) {
  const auto shown = [&](int i) { return std::abs(x(i)) < 1e-9 * distance ? 0 : x(i); };
  throw input_error(
      "unmatched interface: fluid node {} at ({:.6g}, {:.6g}, {:.6g}) {} is {:.4g} mm away from the wall, more than "
      "{:.2g} mm (coupling.mapping_distance): is one of them in another unit, at another place, or of another size?",
      node, shown(0), shown(1), shown(2), units.symbol(dimension::length), units.to_mm(distance), units.to_mm(trust));
}

/// The places that the fluid's nodes follow. Throws InputError if one is farther than trusted.
std::vector<FollowedPlace> places_of(const Points& fluid, const TriangleLocator& solid, double trust,
                                     const UnitSystem& units) {
  std::vector<FollowedPlace> places;
  for (int node = 0; node < fluid.cols(); ++node) {
    const NearestPlace nearest = nearest_place(solid, fluid.col(node));
    if (nearest.distance > trust) refuse(node, fluid.col(node), nearest.distance, trust, units);
    places.push_back(nearest.place);
  }
  return places;
}

void add(Entries& entries, int row, const FollowedPlace& place, double factor) {
  for (std::size_t k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        entries.emplace_back(3 * row + i, 3 * place.nodes[k] + j, factor * place.shares[k](i, j));
}

Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of(const Entries& entries, Eigen::Index rows, Eigen::Index columns) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.prune(0.0);
  return matrix;
}

/// Integrals of a triangle's three hat functions times the motion of the solid beside it, rows of its nodes: over the
/// pieces beside one triangle of the solid by a rule that is exact to second degree. What these pieces lack of the
/// whole triangle, and a linear motion shows it, is taken from the places that the corners follow.
void add_integrals(Entries& entries, const Triangle& nodes, const Points& points, const TriangleLocator& solid,
                   const std::vector<FollowedPlace>& places) {
  const Mat3 corners = points(Eigen::all, nodes);
  const double area = area_vector(points, nodes).norm();
  Mat3 rest = area / 12 * (Mat3::Ones() + Mat3::Identity());  // the triangle's P1 mass
  for (const OverlapPiece& piece : overlap(corners, solid)) {
    const Triangle& other = solid.triangles()[static_cast<std::size_t>(piece.other)];
    const TrianglePlane plane(solid.points()(Eigen::all, other));
    const double third = area * piece.corners.determinant() / 3;
    for (int point = 0; point < 3; ++point) {
      const Vec3 weights = piece.corners * (Vec3::Constant(1.0 / 6) + 0.5 * Vec3::Unit(point));
      const FollowedPlace place = followed_place(other, plane, corners * weights);
      for (int i = 0; i < 3; ++i) add(entries, nodes[static_cast<std::size_t>(i)], place, third * weights(i));
      rest -= third * weights * weights.transpose();
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      add(entries, nodes[static_cast<std::size_t>(i)],
          places[static_cast<std::size_t>(nodes[static_cast<std::size_t>(j)])], rest(i, j));
}

}  // namespace

InterfaceMap InterfaceMap::nearest_triangle(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust,
                                            const UnitSystem& units) {
  const std::vector<FollowedPlace> places = places_of(fluid.points, locator_of(solid), trust, units);
  Entries entries;
  for (std::size_t a = 0; a < places.size(); ++a) add(entries, static_cast<int>(a), places[a], 1);
  return {fluid.points, solid.points, rows_of(entries, fluid.points.size(), solid.points.size()), {}, {}};
}

InterfaceMap InterfaceMap::mortar(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust,
                                  const UnitSystem& units) {
  check_triangles("fluid", fluid);
  const TriangleLocator surface = locator_of(solid);
  const std::vector<FollowedPlace> places = places_of(fluid.points, surface, trust, units);
  const MortarSpace space(fluid);
  Entries rows, rims;  // of all nodes the integral of hat function and motion, less that of what the rims do; of rims H
  for (const Triangle& t : fluid.triangles) {
    add_integrals(rows, t, fluid.points, surface, places);
    const double area = area_vector(fluid.points, t).norm();
    for (const int b : t)
      if (space.is_rim(b))
        for (const int a : t) add(rows, a, places[static_cast<std::size_t>(b)], -area / (a == b ? 6 : 12));
  }
  for (std::size_t a = 0; a < places.size(); ++a)
    if (space.is_rim(static_cast<int>(a))) add(rims, static_cast<int>(a), places[a], 1);
  const auto of = [&](const Entries& entries) { return rows_of(entries, fluid.points.size(), solid.points.size()); };
  Rows all = space.tests() * of(rows);
  all += of(rims);
  return {fluid.points, solid.points, all, space.solved(), space.mass()};
}

}  // namespace tether
