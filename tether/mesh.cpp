#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/config/case_file.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/vtu_writer.hpp"
#include "pictures/pictures.hpp"
#include "tether/verbs.hpp"
#include "vessel/check.hpp"
#include "vessel/coordinates.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/vessel_files.hpp"

namespace tether {
namespace {

/// Triangles of many named faces on one set of points, each with the number of its face.
struct Faces {
  std::vector<std::string> names;
  std::vector<Triangle> triangles;
  std::vector<double> numbers;

  void add(const std::string& name, const std::vector<Triangle>& face) {
    triangles.insert(triangles.end(), face.begin(), face.end());
    numbers.insert(numbers.end(), face.size(), static_cast<double>(names.size()));
    names.push_back(name);
  }
  void write(const std::filesystem::path& path, const Points& points) const {
    write_vtu(path, points, {.triangles = triangles}, {}, {{"face", 1, numbers}});
  }
  std::string legend() const {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("{}{} {}", i ? ", " : "", i, names[i]);
    return text;
  }
};

Faces faces_of(const FluidMesh& fluid) {
  Faces faces;
  faces.add("interface", fluid.interface);
  for (const auto* patches : {&fluid.inlets, &fluid.outlets})
    for (const auto& patch : *patches) faces.add(patch.name, patch.triangles);
  return faces;
}

Faces faces_of(const WallMesh& wall) {
  Faces faces;
  faces.add("interface", wall.interface);
  for (const auto* patches : {&wall.outside, &wall.rings})
    for (const auto& patch : *patches) faces.add(patch.name, patch.triangles);
  return faces;
}

/// The regions of the outer wall exactly, their borders cutting triangles: each part by itself.
void write_regions(const std::filesystem::path& path, const WallMesh& wall) {
  std::vector<Vec3> corners;
  std::vector<double> numbers;
  for (std::size_t region = 0; region < wall.outside.size(); ++region)
    for (const TrianglePart& part : parts_of(wall.outside[region])) {
      const Mat3 places = wall.points(Eigen::all, part.of) * part.corners;
      for (Eigen::Index i = 0; i < 3; ++i) corners.emplace_back(places.col(i));
      numbers.push_back(static_cast<double>(region));
    }
  Points points(3, static_cast<Eigen::Index>(corners.size()));
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < corners.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = corners[i];
  for (int i = 0; i < static_cast<int>(corners.size()); i += 3) triangles.push_back({i, i + 1, i + 2});
  write_vtu(path, points, {.triangles = triangles}, {}, {{"region", 1, numbers}});
}

std::string regions_legend(const WallMesh& wall) {
  std::string text;
  for (std::size_t i = 0; i < wall.outside.size(); ++i)
    text += fmt::format("{}{} {}", i ? ", " : "", i, wall.outside[i].name);
  return text;
}

/// Whether a picture of the regions could be drawn. Where the program that draws is not installed the meshes are there
/// all the same.
bool draw_regions(const std::filesystem::path& folder, const WallMesh& wall) try {
  std::vector<std::string> options{"--field", "region", "--title", "region", "--names"};
  for (const Patch& region : wall.outside) options.push_back(region.name);
  return has_display_server() && draw_picture(folder / "regions.vtu", folder / "regions.png", options);
} catch (const InputError&) {
  return false;
}

ReadVessel mesh_of(const CommandLine& command, CaseFile& file) {
  MeshCase mesh;
  file.read("mesh", mesh);
  file.finish();
  if (!command.quiet) std::cout << file.common().name << ": " << file.common().title << std::endl;
  return load_mesh_and_growth(mesh, file, file.given("solid.element") == "p1" ? WallElement::p1 : WallElement::prism);
}

std::string report_text(const VesselMesh& vessel, const UnitSystem& units) {
  const MeshReport r = report(vessel);
  const auto part = [](const char* name, int nodes, int elements, const Quality& quality) {
    return fmt::format("  {:<6} {} nodes, {} elements; radius ratio {:.2f} on average, {:.2f} at worst\n", name, nodes,
                       elements, quality.mean_radius_ratio, quality.min_radius_ratio);
  };
  return part("fluid", r.fluid_nodes, r.fluid_elements, r.fluid) + part("wall", r.wall_nodes, r.wall_elements, r.wall) +
         fmt::format("  lumen {:.1f} mm wide, wall {:.2f} mm thick on average\n", units.to_mm(r.lumen_diameter),
                     units.to_mm(r.wall_thickness));
}

std::string areas_text(const WallMesh& wall, const UnitSystem& units) {
  std::string text;
  for (const Patch& region : wall.outside)
    text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", region.name,
                        area_of(wall.points, region) * std::pow(units.to_mm(1) / 10, 2));
  return "  outer wall [cm2]: " + text + "\n";
}

/// Whether the meshes may mark the folder: results of a run keep the mark that says of which case they are.
bool is_to_be_marked(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / case_as_run)) return true;
  const std::set<std::string> ours{case_as_run, folder_lock_name, "mesh"};
  return std::all_of(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator(),
                     [&](const auto& entry) { return ours.contains(entry.path().filename().string()); });
}

constexpr double flat = 0.05;  ///< radius ratio below which a solution suffers
constexpr double thinner = 0.95;

/// What a person should look at.
std::string warnings_text(const ReadVessel& read) {
  std::string text;
  const FluidMesh& fluid = read.mesh.fluid;
  if (const Quality blood = report(read.mesh).fluid; blood.min_radius_ratio < flat) {
    const Vec3 at = fluid.points.col(fluid.tetrahedra[static_cast<std::size_t>(blood.worst)][0]);
    text += fmt::format("  warning: a tetrahedron of the blood near {} is nearly flat: radius ratio {:.2g}\n",
                        coordinates(at), blood.min_radius_ratio);
  }
  if (!read.growth) return text;
  Eigen::Index at = 0;
  const double share = read.growth->thickness.cwiseQuotient(read.growth->asked).minCoeff(&at);
  if (share < thinner)
    text += fmt::format("  warning: the wall near {} is {:.0f} % as thick as asked: it has no room for more there\n",
                        coordinates(read.mesh.wall.points.col(at)), 100 * share);
  return text;
}

}  // namespace

int write_meshes(const CommandLine& command) {
  CaseFile file(command.case_file);
  const ReadVessel read = mesh_of(command, file);
  const VesselMesh& vessel = read.mesh;
  const std::filesystem::path output = claim_output(command, file), folder = output / "mesh";
  const bool is_marked = is_to_be_marked(output);
  if (is_marked) mark_output(output, command.case_file);
  std::filesystem::create_directories(folder);
  const Faces fluid_faces = faces_of(vessel.fluid), wall_faces = faces_of(vessel.wall);
  write_vtu(folder / "fluid.vtu", vessel.fluid.points, cells_of(vessel.fluid), {});
  write_vtu(folder / "wall.vtu", vessel.wall.points, cells_of(vessel.wall), {});
  fluid_faces.write(folder / "fluid_faces.vtu", vessel.fluid.points);
  wall_faces.write(folder / "wall_faces.vtu", vessel.wall.points);
  write_regions(folder / "regions.vtu", vessel.wall);
  const bool drawn = draw_regions(folder, vessel.wall);
  if (command.quiet) return exit_done;
  std::cout << report_text(vessel, file.units()) << areas_text(vessel.wall, file.units()) << warnings_text(read)
            << "In " << folder.string() << ", for ParaView:\n"
            << "  fluid.vtu, wall.vtu\n"
            << "  fluid_faces.vtu   colour by face: " << fluid_faces.legend() << "\n"
            << "  wall_faces.vtu    colour by face: " << wall_faces.legend() << "\n"
            << "  regions.vtu       colour by region: " << regions_legend(vessel.wall) << "\n"
            << (drawn ? "  regions.png       the same as a picture\n" : "");
  if (!is_marked)
    std::cout << "  They are of the case as it is now, the other results of the case in "
              << (output / case_as_run).string() << "\n";
  return exit_done;
}

}  // namespace tether
