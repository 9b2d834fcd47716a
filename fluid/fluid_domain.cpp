#include "fluid/fluid_domain.hpp"

#include <algorithm>
#include <set>

#include "common/base/error.hpp"

namespace tether::fluid {
namespace {

std::vector<EndFace> end_faces(const std::vector<Patch>& patches, const FluidMesh& mesh,
                               const std::vector<int>& sigma_nodes) {
  std::vector<EndFace> result;
  for (const auto& patch : patches) result.emplace_back(patch, mesh, sigma_nodes);
  return result;
}

std::vector<int> all_boundary_nodes(const FluidMesh& mesh) {
  std::set<int> nodes;
  const auto add = [&](const std::vector<Triangle>& triangles) {
    for (int node : nodes_of(triangles)) nodes.insert(node);
  };
  add(mesh.interface);
  for (const auto& patch : mesh.inlets) add(patch.triangles);
  for (const auto& patch : mesh.outlets) add(patch.triangles);
  return {nodes.begin(), nodes.end()};
}

void check_apart(const std::vector<Patch>& inlets, const std::vector<Patch>& outlets) {
  std::map<int, std::string> owner;
  for (const auto* list : {&inlets, &outlets})
    for (const auto& patch : *list)
      for (int node : nodes_of(patch.triangles))
        if (const auto [place, fresh] = owner.emplace(node, patch.name); !fresh)
          throw input_error("faces \"{}\" and \"{}\" of the fluid mesh share node {}", place->second, patch.name, node);
}

void check_volumes(const FluidMesh& mesh) {
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
    if (const double volume = tet_geometry(gather(mesh.points, mesh.tetrahedra[e])).volume; !(volume > 0))
      throw input_error("element {} of the fluid mesh has the volume {}", e, volume);
}

/// A number for each node; those of one end have the same, because its pressure is one unknown.
std::vector<int> pressure_unknowns(const FluidMesh& mesh) {
  std::vector<int> unknown(static_cast<std::size_t>(mesh.points.cols()), -1);
  int count = 0;
  for (const auto* patches : {&mesh.inlets, &mesh.outlets})
    for (const Patch& patch : *patches) {
      for (int node : nodes_of(patch.triangles)) unknown[static_cast<std::size_t>(node)] = count;
      ++count;
    }
  for (int& number : unknown)
    if (number < 0) number = count++;
  return unknown;
}

Share shared(const FluidMesh& mesh, Team& team) {
  if (team.is_alone()) return Share(static_cast<int>(mesh.points.cols()));
  const std::vector<int> unknown = pressure_unknowns(mesh);
  const int count = 1 + *std::max_element(unknown.begin(), unknown.end());
  std::vector<int> weights(static_cast<std::size_t>(count), 0), owner;
  for (int number : unknown) ++weights[static_cast<std::size_t>(number)];
  std::vector<Tetrahedron> elements = mesh.tetrahedra;
  for (Tetrahedron& element : elements)
    for (int& node : element) node = unknown[static_cast<std::size_t>(node)];
  const ScatterMap graph(count, 1, std::span<const Tetrahedron>(elements));
  const std::vector<int> parts = cut_graph(graph.zero_matrix(), weights, team.size());
  for (int number : unknown) owner.push_back(parts[static_cast<std::size_t>(number)]);
  return Share(team, std::move(owner));
}

}  // namespace

FluidDomain::FluidDomain(FluidMesh mesh, MeshMotionKind motion, Team& team)
    : sigma(mesh.interface, mesh),
      inlets(end_faces(mesh.inlets, mesh, sigma.nodes)),
      outlets(end_faces(mesh.outlets, mesh, sigma.nodes)),
      mesh_(std::move(mesh)),
      share_(shared(mesh_, team)),
      motion_(mesh_, all_boundary_nodes(mesh_), motion, share_) {
  if (!share_.is_whole()) {
    numbers_ = share_.elements_here(mesh_.tetrahedra);
    for (int number : numbers_) here_.push_back(mesh_.tetrahedra[static_cast<std::size_t>(number)]);
  }
  geometry_ = geometry_of(mesh_.points, tetrahedra());
  check_apart(mesh_.inlets, mesh_.outlets);
  check_volumes(mesh_);
  reference_volumes_.reserve(geometry_.size());
  for (const TetGeometry& element : geometry_) reference_volumes_.push_back(element.volume);
}

int FluidDomain::place_of(int element) const {
  if (share_.is_whole()) return element;
  const auto place = std::lower_bound(numbers_.begin(), numbers_.end(), element);
  return place != numbers_.end() && *place == element ? static_cast<int>(place - numbers_.begin()) : -1;
}

Points FluidDomain::on_boundary(const Points& on_sigma) const {
  Points result = Points::Zero(3, node_count());
  result(Eigen::all, sigma.nodes) = on_sigma;
  for (const auto* faces : {&inlets, &outlets})
    for (const auto& face : *faces) {
      Points on_face = face.local(result);
      face.extend_from_rim(on_face);
      result(Eigen::all, face.nodes) = on_face;
    }
  return result;
}

Points FluidDomain::extend(const Points& on_sigma) const {
  const Points boundary = on_boundary(on_sigma);
  return motion_.extend(boundary(Eigen::all, motion_.boundary_nodes()));
}

void FluidDomain::place(const Points& displacement) {
  const Points points = mesh_.points + displacement;
  set_geometry(geometry_, points, tetrahedra());
  check_jacobians(points);
  sigma.place(points);
  for (auto* faces : {&inlets, &outlets})
    for (auto& face : *faces) face.place(points);
}

void FluidDomain::check_jacobians(const Points& points) const {
  const WorstElement worst = worst_element(geometry_, reference_volumes_);
  const Team::Least least = share_.team().least(worst.ratio);
  if (is_sound(least.value)) return;
  const int number = share_.is_whole() ? static_cast<int>(worst.element) : numbers_[worst.element];
  throw RunError(
      share_.team().text_of(least.rank, folded_text(number, gather(points, tetrahedra()[worst.element]), worst.ratio)));
}

double FluidDomain::smallest_jacobian() const {
  return share_.team().least(worst_element(geometry_, reference_volumes_).ratio).value;
}

double FluidDomain::volume(const Points& on_sigma) const {
  const Points points = mesh_.points + on_boundary(on_sigma);
  double result = sigma.enclosed(sigma.local(points));
  for (const auto* faces : {&inlets, &outlets})
    for (const auto& face : *faces) result += face.enclosed(face.local(points));
  return result;
}

}  // namespace tether::fluid
