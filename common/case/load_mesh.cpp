#include "common/base/error.hpp"
#include "common/case/mesh_case.hpp"
#include "common/io/contours.hpp"
#include "common/io/vessel_files.hpp"
#include "common/mesh/check.hpp"
#include "common/mesh/sweep.hpp"

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

VesselMesh swept(const SweptCase& given, const UnitSystem& units) {
  SweepSettings settings;
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
  settings.disc = {given.around, given.boundary_layers, given.boundary_layer_ratio};
  settings.regions = regions_of(given.regions);
  return sweep(settings);
}

void set_grown_wall(VesselFiles& files, const std::optional<GrownWallCase>& given) {
  if (!given) return;
  files.extrusion = {given->thickness, given->layers, given->smoothing};
  files.regions = regions_of(given->regions);
  files.angle_origin = given->angle_origin;
}

FaceSource source_of(const FaceCase& face) {
  return {face.file, face.label};
}

NamedFaces sources_of(const Named<FaceCase>& faces) {
  NamedFaces sources;
  for (const auto& [name, face] : faces) sources.emplace_back(name, source_of(face));
  return sources;
}

VesselFiles files_of(const FilesCase& given) {
  VesselFiles files;
  files.fluid = given.fluid;
  files.wall = given.wall;
  files.interface = source_of(given.interface);
  files.wall_interface = source_of(given.wall_interface);
  files.inlets = sources_of(given.inlets);
  files.outlets = sources_of(given.outlets);
  files.outside = sources_of(given.outside);
  files.rings = sources_of(given.rings);
  files.label_array = given.label_array;
  files.scale = given.scale;
  set_grown_wall(files, given.grown_wall);
  return files;
}

/// The surface of this name in a SimVascular folder. Throws InputError naming those that exist.
FaceSource surface_in(const std::filesystem::path& folder, const std::string& face) {
  const std::filesystem::path surfaces = folder / "mesh-surfaces", file = surfaces / (face + ".vtp");
  if (std::filesystem::exists(file)) return {file, {}};
  std::string known;
  if (std::filesystem::is_directory(surfaces))
    for (const auto& entry : std::filesystem::directory_iterator(surfaces)) known += " " + entry.path().stem().string();
  throw input_error("{}: does not exist; faces there:{}", file.string(), known.empty() ? " none" : known);
}

NamedFaces surfaces_in(const std::filesystem::path& folder, const Named<FolderFaceCase>& faces) {
  NamedFaces sources;
  for (const auto& [name, face] : faces) sources.emplace_back(name, surface_in(folder, face.face));
  return sources;
}

VesselFiles files_of(const MeshCompleteCase& given) {
  VesselFiles files;
  files.fluid = given.fluid / "mesh-complete.mesh.vtu";
  files.interface = surface_in(given.fluid, given.interface);
  files.inlets = surfaces_in(given.fluid, given.inlets);
  files.outlets = surfaces_in(given.fluid, given.outlets);
  if (!given.wall.empty()) {
    files.wall = given.wall / "mesh-complete.mesh.vtu";
    files.wall_interface = surface_in(given.wall, given.wall_interface);
    files.outside = surfaces_in(given.wall, given.outside);
    files.rings = surfaces_in(given.wall, given.rings);
  }
  files.scale = given.scale;
  set_grown_wall(files, given.grown_wall);
  return files;
}

VesselMesh from_source(const MeshCase& mesh, const UnitSystem& units, WallElement element) {
  if (mesh.source == "swept") return swept(mesh.swept, units);
  VesselFiles files = mesh.source == "files" ? files_of(mesh.files) : files_of(mesh.mesh_complete);
  files.prisms = element == WallElement::prism;
  return read_vessel(files);
}

}  // namespace

VesselMesh load_mesh(const MeshCase& mesh, const UnitSystem& units, WallElement element) {
  VesselMesh vessel = from_source(mesh, units, element);
  if (element == WallElement::p1) use_tetrahedra(vessel.wall);
  check(vessel, units);
  return vessel;
}

}  // namespace tether
