#include "vessel/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "common/base/effect.hpp"
#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "vessel/coordinates.hpp"

namespace tether {

namespace {

Vec3 middle(const Points& points, std::span<const int> nodes) {
  Vec3 sum = Vec3::Zero();
  for (const int node : nodes) sum += points.col(node);
  return sum / static_cast<double>(nodes.size());
}

double total_volume(const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  double sum = 0;
  for (const Tetrahedron& t : tetrahedra) sum += signed_volume(points, t);
  return sum;
}

double longest_edge(const Points& points, const Tetrahedron& t) {
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, (points.col(t[i]) - points.col(t[j])).norm());
  return longest;
}

/// An element's volume over the cube of its longest edge: 0.118 for a regular one, 1e-4 in a boundary layer of aspect
/// ratio 1000.
constexpr double flat = 1e-6;

/// parts: tetrahedra of each element, one after the other (three for a prism).
void check_shapes(const std::string& mesh, const char* element, const Points& points,
                  const std::vector<Tetrahedron>& tetrahedra, std::size_t parts) {
  std::size_t bad = 0, worst = 0;
  double lowest = infinite;
  for (std::size_t e = 0; e < tetrahedra.size(); e += parts) {
    double of_element = infinite;
    for (std::size_t i = e; i < e + parts; ++i) {
      const double shape = signed_volume(points, tetrahedra[i]) / std::pow(longest_edge(points, tetrahedra[i]), 3);
      of_element = std::min(of_element, shape);
      if (shape < lowest) lowest = shape, worst = i;
    }
    if (!(of_element >= flat)) ++bad;
  }
  if (bad == 0) return;
  const double volume = signed_volume(points, tetrahedra[worst]);
  throw input_error(
      "{}: {} of {} {} are inverted or flat: the worst is number {} near {}, volume {:.3g} with edges of {:.3g}: must "
      "be "
      "positive{}, and not flat",
      mesh, bad, tetrahedra.size() / parts, element, worst / parts, coordinates(middle(points, tetrahedra[worst])),
      volume, longest_edge(points, tetrahedra[worst]), parts == 3 ? ", the wall's thickness too" : "");
}

void check_parts(const std::string& mesh, const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  if (tetrahedra.empty()) throw input_error("{}: has no elements", mesh);
  const Parts parts = connected_parts(static_cast<int>(points.cols()), tetrahedra);
  if (parts.count == 1) return;
  const auto other = static_cast<std::size_t>(std::find(parts.part.begin(), parts.part.end(), 1) - parts.part.begin());
  throw input_error("{}: falls into {} separate parts, one of them near {}: must be one", mesh, parts.count,
                    coordinates(middle(points, tetrahedra[other])));
}

struct Face {
  std::string name;
  const std::vector<Triangle>& triangles;
};

void check_boundary(const std::string& mesh, const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                    const std::vector<Face>& faces, const char* rule) {
  std::map<Triangle, const Face*> owner;
  for (const Triangle& t : boundary_triangles(tetrahedra)) owner[sorted(t)] = nullptr;
  for (const Face& face : faces) {
    if (face.triangles.empty()) throw input_error("{}: face {}: has no triangle", mesh, face.name);
    for (const Triangle& t : face.triangles) {
      const auto found = owner.find(sorted(t));
      if (found == owner.end())
        throw input_error("{}: face {}: its triangle near {} is not on the mesh's boundary", mesh, face.name,
                          coordinates(middle(points, t)));
      if (found->second != nullptr)
        throw input_error("{}: the boundary triangle near {} is in two faces, {} and {}", mesh,
                          coordinates(middle(points, t)), found->second->name, face.name);
      found->second = &face;
    }
  }
  const auto open = [](const auto& entry) { return entry.second == nullptr; };
  if (const auto first = std::find_if(owner.begin(), owner.end(), open); first != owner.end())
    throw input_error("{}: {} of its {} boundary triangles carry no label, the first near {}: each must be in {}", mesh,
                      std::count_if(owner.begin(), owner.end(), open), owner.size(),
                      coordinates(middle(points, first->first)), rule);
}

std::vector<Face> faces_of(const std::vector<Triangle>& interface, const std::vector<Patch>& some,
                           const std::vector<Patch>& others) {
  std::vector<Face> faces{{"interface", interface}};
  for (const auto* patches : {&some, &others})
    for (const Patch& patch : *patches) faces.push_back({patch.name, patch.triangles});
  return faces;
}

std::vector<Tetrahedron> tetrahedra_of(const WallMesh& wall) {
  return wall.prisms.empty() ? wall.tetrahedra : split_into_tetrahedra(wall.prisms);
}

/// The power of ten that brings a diameter nearest to a vessel's 15 mm.
double likely_factor(double diameter_mm) {
  return std::pow(10.0, std::round(std::log10(15.0 / diameter_mm)));
}

/// A velocity is spread over nodes inside the rim, which is the wall's: a face without one lets nothing through.
void check_open(const std::string& mesh, const FluidMesh& fluid, const std::vector<Patch>& faces) {
  const std::vector<int> wall = nodes_of(fluid.interface);
  for (const Patch& face : faces) {
    const std::vector<int> nodes = nodes_of(face.triangles);
    if (std::includes(wall.begin(), wall.end(), nodes.begin(), nodes.end()))
      throw input_error("{}: face {}, near {}, has no node inside its rim: the triangles there must be smaller", mesh,
                        face.name, coordinates(middle(fluid.points, nodes)));
  }
}

}  // namespace

void check(const FluidMesh& fluid) {
  const std::string mesh = "fluid mesh";
  check_parts(mesh, fluid.points, fluid.tetrahedra);
  check_shapes(mesh, "tetrahedra", fluid.points, fluid.tetrahedra, 1);
  if (fluid.inlets.empty() && fluid.outlets.empty()) throw input_error("{}: has neither inlet nor outlet", mesh);
  check_boundary(mesh, fluid.points, fluid.tetrahedra, faces_of(fluid.interface, fluid.inlets, fluid.outlets),
                 "the interface, an inlet or an outlet");
  check_open(mesh, fluid, fluid.inlets);
  check_open(mesh, fluid, fluid.outlets);
}

void check(const WallMesh& wall) {
  const std::string mesh = "wall mesh";
  const std::vector<Tetrahedron> tetrahedra = tetrahedra_of(wall);
  check_parts(mesh, wall.points, tetrahedra);
  check_shapes(mesh, wall.prisms.empty() ? "tetrahedra" : "prisms", wall.points, tetrahedra,
               wall.prisms.empty() ? 1 : 3);
  check_boundary(mesh, wall.points, tetrahedra, faces_of(wall.interface, wall.outside, wall.rings),
                 "the interface, the outside or a ring");
}

double mean_lumen_diameter(const FluidMesh& fluid) {
  return 4 * total_volume(fluid.points, fluid.tetrahedra) / total_area(fluid.points, fluid.interface);
}

double mean_wall_thickness(const WallMesh& wall) {
  double outside = 0;
  for (const Patch& patch : wall.outside) outside += total_area(wall.points, patch.triangles);
  return 2 * total_volume(wall.points, tetrahedra_of(wall)) / (outside + total_area(wall.points, wall.interface));
}

void check_interface(const VesselMesh& vessel) {
  const std::vector<int> nodes = nodes_of(vessel.fluid.interface);
  const WallMesh& wall = vessel.wall;
  if (static_cast<int>(nodes.size()) != wall.interface_nodes)
    throw input_error("interface: {} nodes on the fluid's side, {} on the wall's: must be the same", nodes.size(),
                      wall.interface_nodes);
  const double tolerance = 1e-6 * mean_lumen_diameter(vessel.fluid);
  for (int i = 0; i < wall.interface_nodes; ++i) {
    const int node = nodes[static_cast<std::size_t>(i)];
    const Vec3 x = vessel.fluid.points.col(node), y = wall.points.col(i);
    if ((x - y).norm() > tolerance)
      throw input_error("interface: fluid node {} at {} and wall node {} at {} are {:.3g} apart: must coincide", node,
                        coordinates(x), i, coordinates(y), (x - y).norm());
  }
  std::vector<Triangle> of_fluid, of_wall;
  for (const Triangle& t : vessel.fluid.interface) of_fluid.push_back(sorted(t));
  for (const Triangle& t : wall.interface) {
    const auto node = [&](int i) { return nodes[static_cast<std::size_t>(i)]; };
    of_wall.push_back(sorted({node(t[0]), node(t[1]), node(t[2])}));
  }
  std::sort(of_fluid.begin(), of_fluid.end());
  std::sort(of_wall.begin(), of_wall.end());
  if (of_fluid != of_wall)
    throw input_error("interface: fluid and wall have the same nodes but connect them by other triangles");
}

void check_lumen(const FluidMesh& fluid, const UnitSystem& units, const std::string& where) {
  const double diameter = mean_lumen_diameter(fluid), in_mm = units.to_mm(diameter);
  if (diameter > 0 && !(in_mm >= 0.3 && in_mm <= 120))
    throw input_error(
        "{}: the lumen's mean diameter is {:.4g} {} = {:.4g} mm: must be 0.3 to 120 mm in units: {}. Coordinates in "
        "another unit? "
        "Multiplied by {:g} it would be {:.3g} mm",
        where, diameter, units.symbol(dimension::length), in_mm, units.name(), likely_factor(in_mm),
        in_mm * likely_factor(in_mm));
}

void check_thickness(const VesselMesh& vessel, const UnitSystem& units, const std::string& where) {
  const double diameter = mean_lumen_diameter(vessel.fluid);
  if (const double thickness = mean_wall_thickness(vessel.wall);
      thickness > 0.5 * diameter || thickness < 1e-3 * diameter)
    throw input_error(
        "{}: the wall is {:.4g} {} thick on average, the lumen {:.4g} {} wide: must be 0.001 to 0.5 of it", where,
        thickness, units.symbol(dimension::length), diameter, units.symbol(dimension::length));
}

/// The size first, if there is a lumen: a lumen of 20 m has elements that are flat for its wall's sake, but that is not
/// what is wrong.
void check(const VesselMesh& vessel, const UnitSystem& units, const std::string& where) {
  check_lumen(vessel.fluid, units, where);
  check(vessel.fluid);
  check(vessel.wall);
  check_interface(vessel);
  check_thickness(vessel, units, where);
}

MeshReport report(const VesselMesh& vessel) {
  const std::vector<Tetrahedron> wall = tetrahedra_of(vessel.wall);
  MeshReport report;
  report.fluid_nodes = static_cast<int>(vessel.fluid.points.cols());
  report.fluid_elements = static_cast<int>(vessel.fluid.tetrahedra.size());
  report.wall_nodes = static_cast<int>(vessel.wall.points.cols());
  report.wall_elements = static_cast<int>(vessel.wall.prisms.size() + vessel.wall.tetrahedra.size());
  report.fluid = quality(vessel.fluid.points, vessel.fluid.tetrahedra);
  report.wall = quality(vessel.wall.points, wall);
  report.lumen_diameter = mean_lumen_diameter(vessel.fluid);
  report.wall_thickness = mean_wall_thickness(vessel.wall);
  report.lumen_volume = total_volume(vessel.fluid.points, vessel.fluid.tetrahedra);
  return report;
}

}  // namespace tether
