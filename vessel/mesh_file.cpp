#include "vessel/mesh_file.hpp"

#include <Eigen/Geometry>
#include <fstream>
#include <utility>

#include "common/base/error.hpp"
#include "common/base/given_number.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/lower_case.hpp"
#include "vessel/readers.hpp"

namespace tether {

std::string file_content(const std::filesystem::path& path) {
  std::ifstream file = input_stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

namespace {

/// Bytes: of a million triangles in text; a volume may have more.
constexpr std::uintmax_t largest_surface = 250'000'000, largest_volume = 4'000'000'000;

std::uintmax_t largest(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".vtu" ? largest_volume : largest_surface;
}

MeshFile read_by_extension(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".vtu" || extension == ".vtp") return read_xml_vtk(path);
  if (extension == ".vtk") return read_legacy_vtk(path);
  if (extension == ".ply") return read_ply(path);
  if (extension == ".msh") return read_gmsh(path);
  if (extension == ".stl") return read_stl(path);
  if (extension == ".obj") return read_obj(path);
  throw input_error("{}: unknown kind of mesh file: must be .vtu, .vtp, .vtk, .ply, .msh, .stl or .obj", path.string());
}

/// Programs disagree on which way a wedge's base looks: turn each so that its base looks toward its top.
void turn_prisms(MeshFile& mesh) {
  for (Prism& p : mesh.prisms) {
    const Vec3 a = mesh.points.col(p[1]) - mesh.points.col(p[0]), b = mesh.points.col(p[2]) - mesh.points.col(p[0]);
    const Vec3 up = mesh.points.col(p[3]) - mesh.points.col(p[0]);
    if (a.cross(b).dot(up) >= 0) continue;
    std::swap(p[1], p[2]);
    std::swap(p[4], p[5]);
  }
}

/// Geometry points of a mesh generator, left-overs of a cut: nodes that no cell uses are no nodes of the mesh.
void drop_unused_nodes(MeshFile& mesh) {
  std::vector<int> number(static_cast<std::size_t>(mesh.points.cols()), -1);
  std::vector<int> kept;
  const auto mark = [&](const auto& elements) {
    for (const auto& element : elements)
      for (const int node : element) number[static_cast<std::size_t>(node)] = 0;
  };
  mark(mesh.tetrahedra), mark(mesh.prisms), mark(mesh.triangles);
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] == 0) {
      number[node] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(node));
    }
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements)
      for (int& node : element) node = number[static_cast<std::size_t>(node)];
  };
  renumber(mesh.tetrahedra), renumber(mesh.prisms), renumber(mesh.triangles);
  mesh.points = Points(mesh.points(Eigen::all, kept));
  if (!mesh.node_ids.empty()) {
    for (std::size_t i = 0; i < kept.size(); ++i) mesh.node_ids[i] = mesh.node_ids[static_cast<std::size_t>(kept[i])];
    mesh.node_ids.resize(kept.size());
  }
}

void check_coordinates(const MeshFile& mesh) {
  for (Eigen::Index node = 0; node < mesh.points.cols(); ++node)
    if (const auto x = mesh.points.col(node); !x.allFinite() || x.cwiseAbs().maxCoeff() > largest_given)
      throw input_error(
          "{}: the point ({}, {}, {}) has a coordinate that is not a {}", mesh.name, x[0], x[1], x[2],
          x.allFinite() ? fmt::format("number from -{:g} to {:g}", largest_given, largest_given) : "finite number");
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path) {
  input_stream(path, std::ios::in, largest(path));
  MeshFile mesh = read_by_extension(path);
  if (mesh.tetrahedra.empty() && mesh.prisms.empty() && mesh.triangles.empty())
    throw input_error("{}: holds no cell of a surface or a volume", mesh.name);
  drop_unused_nodes(mesh);
  check_coordinates(mesh);
  turn_prisms(mesh);
  return mesh;
}

}  // namespace tether
