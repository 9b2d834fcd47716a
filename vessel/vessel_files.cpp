#include "vessel/vessel_files.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "vessel/coordinates.hpp"
#include "vessel/faces.hpp"
#include "vessel/polar_curve.hpp"
#include "vessel/recombine.hpp"

namespace tether {

namespace {

/// Some programs number tetrahedra the other way round; a mesh with both kinds is left for `check` to refuse.
void turn_if_all_inverted(MeshFile& mesh) {
  const auto inverted = [&](const Tetrahedron& t) { return signed_volume(mesh.points, t) < 0; };
  if (!std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), inverted)) return;
  for (Tetrahedron& t : mesh.tetrahedra) std::swap(t[2], t[3]);
}

MeshFile read_volume(const std::filesystem::path& path, double scale) {
  MeshFile mesh = read_mesh_file(path);
  if (mesh.tetrahedra.empty() == mesh.prisms.empty())
    throw input_error("{}: holds {} tetrahedra and {} prisms: must be one kind", mesh.name, mesh.tetrahedra.size(),
                      mesh.prisms.size());
  mesh.points *= scale;
  turn_if_all_inverted(mesh);
  return mesh;
}

std::vector<Patch> find_all(const FaceFinder& finder, const NamedFaces& faces, double scale) {
  std::vector<Patch> patches;
  for (const auto& [name, source] : faces) patches.push_back({name, finder.find(source, scale)});
  return patches;
}

FluidMesh read_fluid(const VesselFiles& files) {
  const MeshFile mesh = read_volume(files.fluid, files.scale);
  if (mesh.tetrahedra.empty()) throw input_error("{}: the lumen must be of tetrahedra", mesh.name);
  const FaceFinder finder(mesh, files.label_array);
  return {mesh.points, mesh.tetrahedra, finder.find(files.interface, files.scale),
          find_all(finder, files.inlets, files.scale), find_all(finder, files.outlets, files.scale)};
}

/// The wall's node at each interface node of the fluid, in the fluid's ascending order.
std::vector<int> partner_nodes(const FluidMesh& fluid, const MeshFile& wall, const std::vector<Triangle>& inner) {
  const std::vector<int> inner_nodes = nodes_of(inner), nodes = nodes_of(fluid.interface);
  const PointLocator locator(wall.points(Eigen::all, inner_nodes));
  const double tolerance = 1e-5 * std::sqrt(total_area(fluid.points, fluid.interface));
  std::vector<int> partners;
  for (const int node : nodes) {
    const Vec3 x = fluid.points.col(node);
    const auto [nearest, distance] = locator.nearest(x);
    if (distance > tolerance)
      throw input_error(
          "interface: fluid node {} at ({:.6g}, {:.6g}, {:.6g}) has no partner on the wall {}: the nearest node lies "
          "{:.3g} away "
          "(at most {:.1g})",
          node, x[0], x[1], x[2], wall.name, distance, tolerance);
    partners.push_back(inner_nodes[static_cast<std::size_t>(nearest)]);
  }
  if (nodes.size() != inner_nodes.size())
    throw input_error("interface: {} nodes on the fluid's side, {} on the wall's ({}): must be the same", nodes.size(),
                      inner_nodes.size(), wall.name);
  return partners;
}

/// Renumbers so that `first` come first, in their order, then the others.
void bring_to_front(MeshFile& mesh, const std::vector<int>& first) {
  const auto count = static_cast<std::size_t>(mesh.points.cols());
  std::vector<int> number(count, -1), old = first;
  for (std::size_t i = 0; i < first.size(); ++i) number[static_cast<std::size_t>(first[i])] = static_cast<int>(i);
  for (std::size_t node = 0; node < count; ++node)
    if (number[node] < 0) {
      number[node] = static_cast<int>(old.size());
      old.push_back(static_cast<int>(node));
    }
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements)
      for (int& node : element) node = number[static_cast<std::size_t>(node)];
  };
  renumber(mesh.tetrahedra), renumber(mesh.prisms), renumber(mesh.triangles);
  mesh.points = Points(mesh.points(Eigen::all, old));
  std::vector<std::int64_t> ids;
  for (std::size_t i = 0; i < mesh.node_ids.size(); ++i) ids.push_back(mesh.node_ids[static_cast<std::size_t>(old[i])]);
  mesh.node_ids = ids;
}

std::vector<Triangle> reversed(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

/// Tetrahedra to prisms, faces with them.
void put_together(WallMesh& wall, const std::string& name) {
  wall.prisms = recombine_prisms(wall.points, wall.tetrahedra, wall.interface, name);
  wall.tetrahedra.clear();
  std::vector<Patch> patches = wall.outside;
  patches.insert(patches.end(), wall.rings.begin(), wall.rings.end());
  patches = carried_over(wall.points, patches, wall.prisms);
  const auto first_ring = patches.begin() + static_cast<std::ptrdiff_t>(wall.outside.size());
  wall.outside.assign(patches.begin(), first_ring);
  wall.rings.assign(first_ring, patches.end());
}

WallMesh read_wall(const VesselFiles& files, const FluidMesh& fluid) {
  MeshFile mesh = read_volume(files.wall, files.scale);
  const std::vector<int> partners =
      partner_nodes(fluid, mesh, FaceFinder(mesh, files.label_array).find(files.wall_interface, files.scale));
  bring_to_front(mesh, partners);
  mesh.points.leftCols(static_cast<Eigen::Index>(partners.size())) =
      fluid.points(Eigen::all, nodes_of(fluid.interface));
  const FaceFinder finder(mesh, files.label_array);
  WallMesh wall{mesh.points,
                mesh.prisms,
                mesh.tetrahedra,
                static_cast<int>(partners.size()),
                reversed(finder.find(files.wall_interface, files.scale)),
                find_all(finder, files.outside, files.scale),
                find_all(finder, files.rings, files.scale)};
  if (files.prisms && wall.prisms.empty()) put_together(wall, mesh.name);
  return wall;
}

/// Angle and position about the line from the first inlet's to the first outlet's centre.
WallPlace place_about_line(const Vec3& x, const Frame& frame, double length) {
  const Vec3 arm = x - frame.centre;
  const double degrees = std::atan2(arm.dot(frame.e2), arm.dot(frame.e1)) * 180 / std::numbers::pi;
  return {degrees < 0 ? degrees + 360 : degrees, std::clamp(arm.dot(frame.normal) / length, 0.0, 1.0)};
}

/// A straight line tells angles only in a tube about it: an arch, or a vessel with branches, would get wrong regions.
void require_tube(const FluidMesh& fluid, const Frame& frame, double length, const std::string& field) {
  if (fluid.inlets.size() != 1 || fluid.outlets.size() != 1)
    throw input_error(
        "{}: angles and positions about the line from inlet to outlet mean nothing in a "
        "vessel with {} inlets and {} outlets: use mesh.files.regions",
        field, fluid.inlets.size(), fluid.outlets.size());
  constexpr int slices = 10;
  std::array<Vec3, slices> sums;
  sums.fill(Vec3::Zero());
  std::array<double, slices> weights{};
  for (const Triangle& t : fluid.interface) {
    const Vec3 arm = centroid(fluid.points, {t}) - frame.centre;
    const auto slice = static_cast<std::size_t>(std::clamp(arm.dot(frame.normal) / length, 0.0, 0.999) * slices);
    const double area = area_vector(fluid.points, t).norm();
    sums[slice] += area * (arm - frame.normal * frame.normal.dot(arm)), weights[slice] += area;
  }
  const double radius = 0.5 * std::sqrt(4 / std::numbers::pi * total_area(fluid.points, fluid.inlets[0].triangles));
  for (std::size_t slice = 0; slice < slices; ++slice)
    if (weights[slice] > 0 && sums[slice].norm() / weights[slice] > 0.5 * radius)
      throw input_error(
          "{}: angles are about the straight line from inlet to outlet, but the vessel's "
          "axis is {:.3g} away from it near {}: use mesh.files.regions with a centreline",
          field, sums[slice].norm() / weights[slice],
          coordinates(frame.centre + frame.normal * length * (double(slice) + 0.5) / slices));
}

WallMesh grown_wall(const VesselFiles& files, const FluidMesh& fluid, std::optional<GrownWall>& growth) {
  growth = grow_wall(fluid, files.extrusion);
  WallMesh wall = std::move(growth->wall);
  if (files.regions.empty()) return wall;
  const Vec3 start = centroid(fluid.points, fluid.inlets.at(0).triangles),
             end = centroid(fluid.points, fluid.outlets.at(0).triangles);
  const Frame frame = make_frame(start, end - start, files.angle_origin);
  require_tube(fluid, frame, (end - start).norm(), files.regions_field);
  wall.outside = divide_by_regions(wall.outside.front().triangles, files.regions, files.regions_field, [&](int node) {
    return place_about_line(wall.points.col(node), frame, (end - start).norm());
  });
  return wall;
}

std::vector<Triangle> all_triangles(const std::vector<Patch>& patches) {
  std::vector<Triangle> all;
  for (const Patch& patch : patches) all.insert(all.end(), patch.triangles.begin(), patch.triangles.end());
  return all;
}

}  // namespace

ReadVessel read_vessel_and_growth(const VesselFiles& files) {
  ReadVessel read;
  VesselMesh& vessel = read.mesh;
  vessel.fluid = read_fluid(files);
  vessel.wall = files.wall.empty() ? grown_wall(files, vessel.fluid, read.growth) : read_wall(files, vessel.fluid);
  if (!files.rules.empty())
    vessel.wall.outside =
        divide_by_rules(vessel.wall.points, all_triangles(vessel.wall.outside), files.rules, files.anatomy.get());
  if (!files.prisms) use_tetrahedra(vessel.wall);
  return read;
}

VesselMesh read_vessel(const VesselFiles& files) {
  return read_vessel_and_growth(files).mesh;
}

}  // namespace tether
