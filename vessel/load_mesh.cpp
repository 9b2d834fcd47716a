#include <functional>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "vessel/anatomy/centreline_file.hpp"
#include "vessel/check.hpp"
#include "vessel/contours.hpp"
#include "vessel/grown_wall.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/sweep.hpp"
#include "vessel/vessel_files.hpp"

namespace tether {

namespace {

std::vector<WallRegion> regions_of(const Named<RegionCase>& named) {
  std::vector<WallRegion> regions;
  for (const auto& [name, r] : named) regions.push_back({name, r.angle[0], r.angle[1], r.position[0], r.position[1]});
  return regions;
}

std::vector<Points> contours_of(const ContoursCase& given, const UnitSystem& units) {
  std::vector<Points> contours = read_contours(given.file);
  const double factor = units.quantity("1 " + given.unit, dimension::length);
  for (Points& contour : contours) contour *= factor;
  return contours;
}

/// Where a field of the case stands, for messages; "" if nobody knows.
using Where = std::function<std::string(const std::string& field)>;

/// Where the field stands if that is known, else its name.
std::string named(const Where& where, const std::string& field) {
  const std::string line = where(field);
  return line.empty() ? field : line;
}

/// Nodes of blood and wall, all told, for which a run has neither the memory nor the time.
constexpr double most_nodes = 2e6;

void check_nodes(const SweptCase& given, const DiscSettings& disc, const std::string& where) {
  const double nodes = (make_disc(disc).node_count() + double(given.around) * (given.layers + 1)) * (given.along + 1.0);
  if (nodes > most_nodes)
    throw input_error("{}: around: {}, along: {} and layers: {} would make {:.3g} nodes: must make at most {:.3g}",
                      where, given.around, given.along, given.layers, nodes, most_nodes);
}

VesselMesh swept(const SweptCase& given, const UnitSystem& units, const Where& where) {
  SweepSettings settings;
  settings.disc = {given.around, given.boundary_layers, given.boundary_layer_ratio};
  check_nodes(given, settings.disc, named(where, "mesh.swept"));
  if (given.contours) {
    settings.sections = contours_of(*given.contours, units);
  } else {
    settings.sections = circular_tube_sections(*given.radius, *given.length, given.around);
  }
  settings.angle_origin = given.angle_origin;
  settings.extend_inlet = given.extend.inlet;
  settings.extend_outlet = given.extend.outlet;
  settings.wall_thickness = given.wall_thickness;
  settings.along = given.along;
  settings.layers = given.layers;
  settings.regions = regions_of(given.regions);
  settings.field = named(where, "mesh.swept");
  settings.regions_field = named(where, "mesh.swept.regions");
  return sweep(settings);
}

void set_grown_wall(VesselFiles& files, const std::optional<GrownWallCase>& given, const std::string& section,
                    const Where& where) {
  if (!given) return;
  files.extrusion = extrusion_of(*given);
  files.extrusion.thickness = given->thickness.thickness.value_or(0);
  const bool by_radius = given->thickness.fraction_of_radius.has_value();
  files.extrusion.field = named(where, section + (by_radius ? ".fraction_of_radius" : ".thickness"));
  if (files.anatomy && (by_radius || !given->branches.empty())) {
    files.extrusion.varying = [tree = thickness_of(*given), anatomy = files.anatomy](const Points& places) {
      return thickness_at(places, tree, *anatomy);
    };
  }
  files.regions = regions_of(given->regions);
  files.regions_field = named(where, section + ".regions");
  files.angle_origin = given->angle_origin;
}

FaceSource source_of(const FaceCase& face, const std::string& where) {
  return {face.file, face.label, face.label_array, where};
}

NamedFaces sources_of(const Named<FaceCase>& faces, const std::string& field, const Where& where) {
  NamedFaces sources;
  for (const auto& [name, face] : faces) sources.emplace_back(name, source_of(face, where(field + "." + name)));
  return sources;
}

std::shared_ptr<const Anatomy> anatomy_of(const std::filesystem::path& centreline, const UnitSystem& units) {
  const CentrelineTree tree = read_centreline(centreline, units);
  try {
    return std::make_shared<const Anatomy>(tree);
  } catch (const InputError& error) {
    throw input_error("{}: {}", centreline.string(), error.what());
  }
}

VesselFiles files_of(const FilesCase& given, const Where& where, const UnitSystem& units) {
  VesselFiles files;
  if (!given.centreline.empty()) files.anatomy = anatomy_of(given.centreline, units);
  files.rules = rules_of(given.regions, files.anatomy.get(), units,
                         [&](const std::string& name) { return named(where, "mesh.files.regions." + name); });
  files.fluid = given.fluid;
  files.wall = given.wall;
  files.interface = source_of(given.interface, where("mesh.files.interface"));
  files.wall_interface = source_of(given.wall_interface, where("mesh.files.wall_interface"));
  files.inlets = sources_of(given.inlets, "mesh.files.inlets", where);
  files.outlets = sources_of(given.outlets, "mesh.files.outlets", where);
  files.outside = sources_of(given.outside, "mesh.files.outside", where);
  files.rings = sources_of(given.rings, "mesh.files.rings", where);
  files.label_array = given.label_array;
  files.scale = given.scale;
  set_grown_wall(files, given.grown_wall, "mesh.files.grown_wall", where);
  return files;
}

/// The surface of this name in a SimVascular folder. Throws InputError naming those that exist.
FaceSource surface_in(const std::filesystem::path& folder, const std::string& face, const std::string& where) {
  const std::filesystem::path surfaces = folder / "mesh-surfaces", file = surfaces / (face + ".vtp");
  if (std::filesystem::exists(file)) return {file, {}, {}, where};
  std::string known;
  if (std::filesystem::is_directory(surfaces))
    for (const auto& entry : std::filesystem::directory_iterator(surfaces)) known += " " + entry.path().stem().string();
  throw input_error("{}{}{}: does not exist; faces there:{}", where, where.empty() ? "" : ": ", file.string(),
                    known.empty() ? " none" : known);
}

NamedFaces surfaces_in(const std::filesystem::path& folder, const Named<FolderFaceCase>& faces,
                       const std::string& field, const Where& where) {
  NamedFaces sources;
  for (const auto& [name, face] : faces)
    sources.emplace_back(name, surface_in(folder, face.face, where(field + "." + name)));
  return sources;
}

VesselFiles files_of(const MeshCompleteCase& given, const Where& where) {
  VesselFiles files;
  files.fluid = given.fluid / "mesh-complete.mesh.vtu";
  files.interface = surface_in(given.fluid, given.interface, where("mesh.mesh_complete.interface"));
  files.inlets = surfaces_in(given.fluid, given.inlets, "mesh.mesh_complete.inlets", where);
  files.outlets = surfaces_in(given.fluid, given.outlets, "mesh.mesh_complete.outlets", where);
  if (!given.wall.empty()) {
    files.wall = given.wall / "mesh-complete.mesh.vtu";
    files.wall_interface = surface_in(given.wall, given.wall_interface, where("mesh.mesh_complete.wall_interface"));
    files.outside = surfaces_in(given.wall, given.outside, "mesh.mesh_complete.outside", where);
    files.rings = surfaces_in(given.wall, given.rings, "mesh.mesh_complete.rings", where);
  }
  files.scale = given.scale;
  set_grown_wall(files, given.grown_wall, "mesh.mesh_complete.grown_wall", where);
  return files;
}

ReadVessel from_source(const MeshCase& mesh, const UnitSystem& units, WallElement element, const Where& where) {
  if (mesh.source == "swept") return {swept(mesh.swept, units, where), {}};
  VesselFiles files = mesh.source == "files" ? files_of(mesh.files, where, units) : files_of(mesh.mesh_complete, where);
  files.prisms = element == WallElement::prism;
  return read_vessel_and_growth(files);
}

ReadVessel checked_mesh(const MeshCase& mesh, const UnitSystem& units, WallElement element, const Where& where) {
  ReadVessel vessel = from_source(mesh, units, element, where);
  if (element == WallElement::p1) use_tetrahedra(vessel.mesh.wall);
  check(vessel.mesh, units, named(where, "mesh"));
  return vessel;
}

}  // namespace

ReadVessel load_mesh_and_growth(const MeshCase& mesh, const CaseFile& file, WallElement element) {
  return checked_mesh(mesh, file.units(), element, [&file](const std::string& field) { return file.where(field); });
}

VesselMesh load_mesh(const MeshCase& mesh, const CaseFile& file, WallElement element) {
  return load_mesh_and_growth(mesh, file, element).mesh;
}

VesselMesh load_mesh(const MeshCase& mesh, const UnitSystem& units, WallElement element) {
  return checked_mesh(mesh, units, element, [](const std::string&) { return ""; }).mesh;
}

}  // namespace tether
