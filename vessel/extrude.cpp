#include "vessel/extrude.hpp"

#include <algorithm>
#include <set>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

namespace tether {

namespace {

/// The interface by itself: its nodes, renumbered 0 .. n - 1 in ascending order of the fluid's.
struct InterfaceSurface {
  std::vector<int> fluid_nodes;
  Points points;
  std::vector<Triangle> triangles;
};

int position_in(const std::vector<int>& ascending, int node) {
  return static_cast<int>(std::lower_bound(ascending.begin(), ascending.end(), node) - ascending.begin());
}

InterfaceSurface interface_surface(const FluidMesh& fluid) {
  InterfaceSurface surface{nodes_of(fluid.interface), {}, fluid.interface};
  surface.points = fluid.points(Eigen::all, surface.fluid_nodes);
  for (Triangle& triangle : surface.triangles)
    for (int& node : triangle) node = position_in(surface.fluid_nodes, node);
  return surface;
}

/// An edge loop of the interface, and the ring that will stand on it.
struct Rim {
  std::string ring;
  std::vector<int> nodes;
};

std::vector<Rim> named_rims(const FluidMesh& fluid, const InterfaceSurface& surface) {
  std::vector<Rim> named;
  for (std::vector<int>& loop : rims(surface.triangles)) {
    const int node = surface.fluid_nodes[static_cast<std::size_t>(loop.front())];
    std::string name;
    for (const auto* patches : {&fluid.inlets, &fluid.outlets})
      for (const Patch& patch : *patches)
        for (const Triangle& t : patch.triangles)
          if (std::find(t.begin(), t.end(), node) != t.end()) name = patch.name + "_ring";
    if (name.empty())
      throw input_error(
          "mesh: the interface has an open edge at fluid node {} that is not the rim of an inlet or outlet", node);
    named.push_back({std::move(name), std::move(loop)});
  }
  return named;
}

/// Each normal replaced by the mean of those of its triangles' nodes.
Points smoothed(const Points& normals, const std::vector<Triangle>& triangles) {
  Points sum = Points::Zero(3, normals.cols());
  for (const Triangle& t : triangles)
    for (const int node : t) sum.col(node) += normals.col(t[0]) + normals.col(t[1]) + normals.col(t[2]);
  return sum.colwise().normalized();
}

void turn_into_rim_planes(Points& directions, const InterfaceSurface& surface, const std::vector<Rim>& rims) {
  for (const Rim& rim : rims) {
    const Vec3 normal = plane_of_loop(surface.points(Eigen::all, rim.nodes)).normal;
    for (const int node : rim.nodes)
      directions.col(node) = (directions.col(node) - normal.dot(directions.col(node)) * normal).normalized();
  }
}

Points growth_directions(const InterfaceSurface& surface, const std::vector<Rim>& rims, int smoothing) {
  Points directions = nodal_normals(surface.points, surface.triangles);
  turn_into_rim_planes(directions, surface, rims);
  for (int pass = 0; pass < smoothing; ++pass) {
    directions = smoothed(directions, surface.triangles);
    turn_into_rim_planes(directions, surface, rims);
  }
  return directions;
}

Triangle shifted(const Triangle& triangle, int by) {
  return {triangle[0] + by, triangle[1] + by, triangle[2] + by};
}

std::vector<Prism> stacked_prisms(const std::vector<Triangle>& triangles, int layers, int nodes) {
  std::vector<Prism> prisms;
  for (int layer = 0; layer < layers; ++layer)
    for (const Triangle& t : triangles) {
      const Triangle b = shifted(t, layer * nodes), a = shifted(t, (layer + 1) * nodes);
      prisms.push_back({b[0], b[1], b[2], a[0], a[1], a[2]});
    }
  return prisms;
}

/// The side faces of all layers over a rim, outward.
Patch ring_patch(const Rim& rim, int layers, int nodes) {
  Patch ring{rim.ring, {}};
  for (std::size_t i = 0; i < rim.nodes.size(); ++i)
    for (int layer = 0; layer < layers; ++layer) {
      const int a = rim.nodes[i] + layer * nodes, b = rim.nodes[(i + 1) % rim.nodes.size()] + layer * nodes;
      for (const Triangle& half : split_quadrilateral(a, b, b + nodes, a + nodes)) ring.triangles.push_back(half);
    }
  return ring;
}

void require_unfolded(const WallMesh& wall) {
  for (const Tetrahedron& part : split_into_tetrahedra(wall.prisms))
    if (const Vec3 at = wall.points.col(part[0]); !(signed_volume(wall.points, part) > 0))
      throw input_error(
          "mesh.wall_thickness: the wall folds over itself near ({:.4g}, {:.4g}, {:.4g}): it is too thick for the "
          "lumen's "
          "curvature there, or the surface is too rough",
          at[0], at[1], at[2]);
}

}  // namespace

WallMesh extrude_wall(const FluidMesh& fluid, const ExtrusionSettings& settings) {
  if (!(settings.thickness > 0)) throw input_error("mesh.wall_thickness: {}: must be positive", settings.thickness);
  if (settings.layers < 1) throw input_error("mesh.layers: {}: must be at least 1", settings.layers);
  const InterfaceSurface surface = interface_surface(fluid);
  const std::vector<Rim> rims = named_rims(fluid, surface);
  const Points directions = growth_directions(surface, rims, settings.smoothing);

  WallMesh wall;
  const int nodes = wall.interface_nodes = static_cast<int>(surface.points.cols());
  wall.points.resize(3, nodes * (settings.layers + 1));
  for (int layer = 0; layer <= settings.layers; ++layer)
    wall.points.middleCols(layer * nodes, nodes) =
        surface.points + settings.thickness * layer / settings.layers * directions;
  wall.prisms = stacked_prisms(surface.triangles, settings.layers, nodes);
  wall.interface = surface.triangles;
  wall.outside.push_back({"wall", {}});
  for (const Triangle& t : surface.triangles)
    wall.outside.front().triangles.push_back(shifted(t, settings.layers * nodes));
  for (const Rim& rim : rims) wall.rings.push_back(ring_patch(rim, settings.layers, nodes));
  require_unfolded(wall);
  return wall;
}

}  // namespace tether
