#include <cmath>
#include <iostream>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/vtu_writer.hpp"
#include "tether/verbs.hpp"
#include "vessel/check.hpp"
#include "vessel/mesh_case.hpp"

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

VesselMesh mesh_of(const CommandLine& command, CaseFile& file) {
  MeshCase mesh;
  file.read("mesh", mesh);
  file.finish();
  if (!command.quiet) std::cout << file.common().name << ": " << file.common().title << std::endl;
  return load_mesh(mesh, file, file.given("solid.element") == "p1" ? WallElement::p1 : WallElement::prism);
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

}  // namespace

int write_meshes(const CommandLine& command) {
  CaseFile file(command.case_file);
  const VesselMesh vessel = mesh_of(command, file);
  const auto folder = claim_and_mark_output(command, file) / "mesh";
  std::filesystem::create_directories(folder);
  const Faces fluid_faces = faces_of(vessel.fluid), wall_faces = faces_of(vessel.wall);
  write_vtu(folder / "fluid.vtu", vessel.fluid.points, cells_of(vessel.fluid), {});
  write_vtu(folder / "wall.vtu", vessel.wall.points, cells_of(vessel.wall), {});
  fluid_faces.write(folder / "fluid_faces.vtu", vessel.fluid.points);
  wall_faces.write(folder / "wall_faces.vtu", vessel.wall.points);
  if (command.quiet) return exit_done;
  std::cout << report_text(vessel, file.units()) << areas_text(vessel.wall, file.units()) << "In " << folder.string()
            << ", for ParaView:\n"
            << "  fluid.vtu, wall.vtu\n"
            << "  fluid_faces.vtu   colour by face: " << fluid_faces.legend() << "\n"
            << "  wall_faces.vtu    colour by face: " << wall_faces.legend() << "\n";
  return exit_done;
}

}  // namespace tether
