#include "vessel/faces.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "common/base/error.hpp"
#include "common/mesh/mesh.hpp"
#include "common/mesh/topology.hpp"
#include "vessel/coordinates.hpp"

namespace tether {

namespace {

std::map<Triangle, std::vector<Triangle>> boundary_of(const MeshFile& volume) {
  std::map<Triangle, std::vector<Triangle>> boundary;
  const std::vector<Tetrahedron> tetrahedra =
      volume.prisms.empty() ? volume.tetrahedra : split_into_tetrahedra(volume.prisms);
  for (const Triangle& t : boundary_triangles(tetrahedra)) boundary[sorted(t)] = {t};
  for (const auto& [a, b, c, d] : boundary_sides(volume.prisms)) {
    const auto halves = split_quadrilateral(a, b, c, d);
    for (const Triangle& corner : {Triangle{a, b, c}, {b, c, d}, {c, d, a}, {d, a, b}})
      boundary[sorted(corner)] = {halves[0], halves[1]};
  }
  return boundary;
}

double size_of(const Points& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

std::string listed_names(const auto& names) {
  std::string list;
  for (const auto& [name, value] : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

std::int64_t label_number(const MeshFile& mesh, const std::string& label) {
  if (const auto group = mesh.group_names.find(label); group != mesh.group_names.end()) return group->second;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
  if (error != std::errc() || end != label.data() + label.size())
    throw input_error("{}: \"{}\" is neither an integer nor the name of a physical surface; names in the file: {}",
                      mesh.name, label, listed_names(mesh.group_names));
  return number;
}

}  // namespace

FaceFinder::FaceFinder(const MeshFile& volume, const std::string& label_array)
    : volume_(volume),
      label_array_(label_array),
      locator_(volume.points),
      tolerance_(1e-5 * size_of(volume.points)),
      boundary_(boundary_of(volume)) {
  for (std::size_t i = 0; i < volume.node_ids.size(); ++i) node_of_id_[volume.node_ids[i]] = static_cast<int>(i);
}

std::vector<Triangle> FaceFinder::find(const FaceSource& source, double scale) const {
  try {
    return found(source, scale);
  } catch (const InputError& error) {
    if (source.where.empty()) throw;
    throw input_error("{}: {}", source.where, error.what());
  }
}

std::vector<Triangle> FaceFinder::found(const FaceSource& source, double scale) const {
  if (source.file.empty()) return on_boundary(labelled(volume_, source), volume_.name);
  MeshFile surface = read_mesh_file(source.file);
  surface.points *= scale;
  std::vector<Triangle> triangles = source.label.empty() ? surface.triangles : labelled(surface, source);
  if (triangles.empty()) throw input_error("{}: holds no triangle", surface.name);
  const std::vector<int> nodes = matched_nodes(surface);
  for (Triangle& t : triangles)
    for (int& node : t) node = nodes[static_cast<std::size_t>(node)];
  return on_boundary(triangles, surface.name);
}

std::vector<int> FaceFinder::matched_nodes(const MeshFile& surface) const {
  const bool by_id = !surface.node_ids.empty() && !node_of_id_.empty();
  std::vector<int> nodes;
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    const Vec3 x = surface.points.col(i);
    const auto known = by_id ? node_of_id_.find(surface.node_ids[static_cast<std::size_t>(i)]) : node_of_id_.end();
    const int node = known != node_of_id_.end() ? known->second : locator_.nearest(x).node;
    const double distance = (volume_.points.col(node) - x).norm();
    if (distance > tolerance_)
      throw input_error("{}: its node {} at {} is no node of {}: {} lies {:.3g} away (at most {:.1g})", surface.name, i,
                        coordinates(x, 6), volume_.name,
                        known != node_of_id_.end() ? "the one of the same GlobalNodeID" : "the nearest", distance,
                        tolerance_);
    nodes.push_back(node);
  }
  return nodes;
}

std::vector<Triangle> FaceFinder::on_boundary(const std::vector<Triangle>& triangles, const std::string& from) const {
  std::vector<Triangle> found;
  std::set<Triangle> taken;
  for (const Triangle& t : triangles) {
    const auto place = boundary_.find(sorted(t));
    if (place == boundary_.end())
      throw input_error("{}: a triangle near {} is not on the boundary of {}", from,
                        coordinates(volume_.points.col(t[0]), 6), volume_.name);
    for (const Triangle& outward : place->second)
      if (taken.insert(sorted(outward)).second) found.push_back(outward);
  }
  return found;
}

std::vector<Triangle> FaceFinder::labelled(const MeshFile& mesh, const FaceSource& source) const {
  const std::string& array = source.label_array.empty() ? label_array_ : source.label_array;
  const bool gmsh = mesh.triangle_labels.contains("physical");
  const auto labels = mesh.triangle_labels.find(gmsh ? "physical" : array);
  if (labels == mesh.triangle_labels.end())
    throw input_error("{}: has no array \"{}\" on triangles; arrays in the file: {}", mesh.name, array,
                      listed_names(mesh.triangle_labels));
  const std::int64_t number = label_number(mesh, source.label);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (labels->second[i] == number) triangles.push_back(mesh.triangles[i]);
  if (triangles.empty()) {
    const std::set<std::int64_t> known(labels->second.begin(), labels->second.end());
    throw input_error("{}: no triangle carries the label {} in \"{}\"; labels there: {}", mesh.name, number,
                      labels->first, fmt::join(known, ", "));
  }
  return triangles;
}

}  // namespace tether
