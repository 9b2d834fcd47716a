#include "vessel/extrude.hpp"

#include <algorithm>
#include <set>

#include "common/base/placed_error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "vessel/coordinates.hpp"
#include "vessel/growth/outer_surface.hpp"

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
          "mesh: the interface has an open edge at {} (fluid node {}) that is not the rim of an inlet or outlet: name "
          "the opening there among them",
          coordinates(fluid.points.col(node)), node);
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

/// Normals of the planes in which rim nodes must stay; zero elsewhere.
Points rim_planes(const InterfaceSurface& surface, const std::vector<Rim>& rims) {
  Points planes = Points::Zero(3, surface.points.cols());
  for (const Rim& rim : rims) {
    const Vec3 normal = plane_of_loop(surface.points(Eigen::all, rim.nodes)).normal;
    for (const int node : rim.nodes) planes.col(node) = normal;
  }
  return planes;
}

VectorXd asked_thickness(const InterfaceSurface& surface, const ExtrusionSettings& settings) {
  const VectorXd asked = settings.varying ? settings.varying(surface.points)
                                          : VectorXd::Constant(surface.points.cols(), settings.thickness);
  if (asked.size() > 0 && !(asked.minCoeff() > 0))
    throw input_error("{}: {}: must be positive", settings.field, asked.minCoeff());
  return asked;
}

void require_thick(const OuterSurface& outer, const InterfaceSurface& surface, const ExtrusionSettings& settings) {
  Eigen::Index at = 0;
  const double share = outer.aim.cwiseQuotient(outer.asked).minCoeff(&at);
  if (share < settings.least_share * (1 - 1e-9))
    throw PlacedError(
        fmt::format("{}: the wall has room for {:.3g} of {:.3g} only near {} without folding over itself or meeting "
                    "itself: ask for less there (a branch may have a thickness of its own), allow it to be thinner "
                    "(least_share), smooth the lumen's surface, or give it shorter edges there",
                    settings.field, outer.aim[at], outer.asked[at], coordinates(surface.points.col(at))),
        {surface.points.col(at)});
}

OuterSurface outer_surface(const InterfaceSurface& surface, const Points& directions, const std::vector<Rim>& rims,
                           const ExtrusionSettings& settings) {
  const GrowthBase base{surface.points, surface.triangles, directions, rim_planes(surface, rims), settings.layers};
  const VectorXd asked = asked_thickness(surface, settings);
  const auto share = [](const OuterSurface& outer) { return outer.aim.cwiseQuotient(outer.asked).minCoeff(); };
  try {
    OuterSurface outer = grow_outer_surface(base, asked);
    if (share(outer) >= settings.least_share * (1 - 1e-9)) return outer;
    OuterSurface thicker = grow_outer_surface(base, asked, short_steps);
    return share(thicker) > share(outer) ? std::move(thicker) : std::move(outer);
  } catch (const PlacedError& error) {
    throw PlacedError(fmt::format("{}: {}", settings.field, error.what()), error.places);
  }
}

}  // namespace

GrownWall grow_wall(const FluidMesh& fluid, const ExtrusionSettings& settings) {
  if (settings.layers < 1) throw input_error("mesh.layers: {}: must be at least 1", settings.layers);
  const InterfaceSurface surface = interface_surface(fluid);
  const std::vector<Rim> rims = named_rims(fluid, surface);
  const Points directions = growth_directions(surface, rims, settings.smoothing);
  const OuterSurface outer = outer_surface(surface, directions, rims, settings);
  require_thick(outer, surface, settings);

  GrownWall grown{
      {}, outer.asked, outer.thickness, static_cast<int>(std::count(outer.moved.begin(), outer.moved.end(), 1))};
  WallMesh& wall = grown.wall;
  const int nodes = wall.interface_nodes = static_cast<int>(surface.points.cols());
  wall.points.resize(3, nodes * (settings.layers + 1));
  const auto way_up = [&](int node, int layer) -> Vec3 {
    if (outer.moved[static_cast<std::size_t>(node)])
      return double(layer) / settings.layers * (outer.points.col(node) - surface.points.col(node));
    return outer.asked[node] * layer / settings.layers * directions.col(node);
  };
  for (int layer = 0; layer <= settings.layers; ++layer)
    for (int node = 0; node < nodes; ++node)
      wall.points.col(layer * nodes + node) = surface.points.col(node) + way_up(node, layer);
  wall.prisms = stacked_prisms(surface.triangles, settings.layers, nodes);
  wall.interface = surface.triangles;
  wall.outside.push_back({"wall", {}});
  for (const Triangle& t : surface.triangles)
    wall.outside.front().triangles.push_back(shifted(t, settings.layers * nodes));
  for (const Rim& rim : rims) wall.rings.push_back(ring_patch(rim, settings.layers, nodes));
  return grown;
}

WallMesh extrude_wall(const FluidMesh& fluid, const ExtrusionSettings& settings) {
  return grow_wall(fluid, settings).wall;
}

}  // namespace tether
