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

}  // namespace

FluidDomain::FluidDomain(FluidMesh mesh, MeshMotionKind motion)
    : sigma(mesh.interface, mesh),
      inlets(end_faces(mesh.inlets, mesh, sigma.nodes)),
      outlets(end_faces(mesh.outlets, mesh, sigma.nodes)),
      mesh_(std::move(mesh)),
      motion_(mesh_, all_boundary_nodes(mesh_), motion),
      geometry_(geometry_of(mesh_.points, mesh_.tetrahedra)) {
  check_apart(mesh_.inlets, mesh_.outlets);
  reference_volumes_.reserve(geometry_.size());
  for (std::size_t e = 0; e < geometry_.size(); ++e) {
    if (!(geometry_[e].volume > 0))
      throw input_error("element {} of the fluid mesh has the volume {}", e, geometry_[e].volume);
    reference_volumes_.push_back(geometry_[e].volume);
  }
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
  set_geometry(geometry_, points, mesh_.tetrahedra);
  check_jacobians(geometry_, reference_volumes_, points, mesh_.tetrahedra);
  sigma.place(points);
  for (auto* faces : {&inlets, &outlets})
    for (auto& face : *faces) face.place(points);
}

double FluidDomain::volume(const Points& on_sigma) const {
  const Points points = mesh_.points + on_boundary(on_sigma);
  double result = sigma.enclosed(sigma.local(points));
  for (const auto* faces : {&inlets, &outlets})
    for (const auto& face : *faces) result += face.enclosed(face.local(points));
  return result;
}

}  // namespace tether::fluid
