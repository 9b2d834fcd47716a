#include "vessel/mesh_case.hpp"

#include <cmath>

#include "common/config/columns.hpp"

namespace tether {

namespace {

constexpr Range up_to_one{0, 1};

/// In any of the unit systems a vessel's lengths lie within this; squares and cubes beyond it would not be finite.
constexpr double shortest_length = 1e-6, longest_length = 1e6;

void check_length(Fields& f, const char* field, std::optional<double> length) {
  f.check(!length || *length == 0 || (*length >= shortest_length && *length <= longest_length), field,
          "must be at least 1e-6 and at most 1e6: no vessel's length is beyond that in any unit");
}

void declare_regions(Fields& f, Named<RegionCase>& regions, Vec3& angle_origin) {
  f.groups("regions", regions,
           "of the outer wall, by name: the first that contains a place takes it; none: one region \"wall\"");
  f.direction("angle_origin", angle_origin,
              "direction of angle zero, projected on each cross-section; angles grow right-handed about the flow");
}

}  // namespace

void RegionCase::declare(Fields& f) {
  f.numbers("angle", angle, {2, dimension::none, {-360, 360}},
            "from and to [degrees] about the axis, right-handed about the flow; may pass through zero: [330, 30]");
  f.numbers("position", position, {2, dimension::none, up_to_one},
            "from and to along the vessel: 0 at the inlet, 1 at the outlet, extensions included");
}

void ContoursCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the columns section, point, x, y, z; sections from inlet to outlet",
         Need::required);
  f.choice("unit", unit, {{"mm", "millimetre"}, {"cm", "centimetre"}, {"m", "metre"}}, "of the file's coordinates");
  for (const char* column : {"section", "x", "y", "z"}) check_column(f, "file", column, file);
}

void ExtendCase::declare(Fields& f) {
  f.number("inlet", inlet, dimension::length, range::not_negative, "before the first contour");
  f.number("outlet", outlet, dimension::length, range::not_negative, "behind the last contour");
  check_length(f, "inlet", inlet);
  check_length(f, "outlet", outlet);
}

void SweptCase::declare(Fields& f) {
  f.number("radius", radius, dimension::length, range::positive,
           "of the lumen of a straight circular tube about the z axis");
  f.number("length", length, dimension::length, range::positive, "of that tube");
  f.group("contours", contours, "measured closed contours, instead of radius and length");
  f.check(contours.has_value() ? !radius && !length : radius && length, contours ? "contours" : "radius",
          "give either radius and length, or contours");
  f.group("extend", extend,
          "straight extension beyond the first and last contour, along the axis, so that the ends are away from them");
  f.number("wall_thickness", wall_thickness, dimension::length, range::positive, "of the imaged wall");
  f.integer("around", around, {8, 1000}, "nodes on the circumference, even");
  f.check(around % 2 == 0, "around", "must be even");
  f.integer("along", along, {1, 10000}, "intervals along the vessel");
  f.integer("layers", layers, {1, 50}, "of the wall");
  f.integer("boundary_layers", boundary_layers, {0, 20}, "thin layers of blood next to the wall");
  f.number("boundary_layer_ratio", boundary_layer_ratio, dimension::none, {0, 1, true, false},
           "thickness of each of them over the one further in (the first: over the spacing of nodes around)");
  declare_regions(f, regions, angle_origin);
  check_length(f, "radius", radius);
  check_length(f, "length", length);
  check_length(f, "wall_thickness", std::isnan(wall_thickness) ? std::nullopt : std::optional(wall_thickness));
}

void FaceCase::declare(Fields& f) {
  f.path("file", file,
         "surface file (.vtp, .vtk, .stl, .msh) whose nodes are the volume's; absent: the volume's own file");
  f.text("label", label,
         "triangles with this value of label_array, or of this Gmsh physical surface; absent: all of the file");
  f.text("label_array", label_array, "of this face; default: that of all");
}

void ThicknessCase::declare(Fields& f) {
  f.number("thickness", thickness, dimension::length, range::positive, "of the imaged wall");
  f.number("fraction_of_radius", fraction_of_radius, dimension::none, {0, 1, true, false},
           "thickness over the lumen's radius there, which the centreline tells, instead");
  f.check(thickness.has_value() != fraction_of_radius.has_value(), "thickness",
          "give either thickness or fraction_of_radius");
}

void GrownWallCase::declare(Fields& f) {
  thickness.declare(f);
  f.groups("branches", branches, "branches of the centreline whose wall is of another thickness, by name");
  f.number("blend", blend, dimension::length, range::positive,
           "way over which the thickness changes about a junction; default: the branch's radius where it begins");
  f.number("least_share", least_share, dimension::none, {0.3, 1},
           "of the thickness: how thin the wall may be where it has no room for more, in the crotch of branches");
  f.integer("layers", layers, {1, 50}, "of prisms");
  f.integer("smoothing", smoothing, {0, 100},
            "times that normals are averaged with their neighbours', for rough surfaces");
  declare_regions(f, regions, angle_origin);
}

namespace {

constexpr std::string_view grown_wall_meaning =
    "a wall extruded from the interface, where no mesh of the wall is given";

bool needs_centreline(const GrownWallCase& wall) {
  return wall.thickness.fraction_of_radius || !wall.branches.empty();
}

/// Either a mesh of the wall with its faces, or one to be grown.
void check_wall(Fields& f, bool mesh, bool grown) {
  f.check(mesh != grown, "wall", "give either the wall's mesh or grown_wall");
}

}  // namespace

void FilesCase::declare(Fields& f) {
  f.path("fluid", fluid, "volume mesh of the lumen: .vtu, .vtk or .msh", Need::required);
  f.group("interface", interface, "the lumen's surface toward the wall");
  f.groups("inlets", inlets, "of the fluid mesh, by name");
  f.groups("outlets", outlets, "of the fluid mesh, by name");
  f.path("wall", wall, "volume mesh of the wall; its nodes on the interface are the fluid's");
  f.group("wall_interface", wall_interface, "the wall's surface toward the lumen");
  f.groups("outside", outside, "regions of the outer wall, by name");
  f.groups("rings", rings, "end faces of the wall, by name");
  f.group("grown_wall", grown_wall, grown_wall_meaning);
  f.path(
      "centreline", centreline,
      "CSV file with the columns branch, parent, x [mm], y [mm], z [mm], radius [mm]; the trunk first; its points are "
      "not scaled");
  f.groups("regions", regions,
           "of the outer wall by geometry, by name: the first that contains a place takes it; none: `outside`, or one "
           "region \"wall\"");
  f.text("label_array", label_array, "cell array that labels refer to, in VTK files, unless a face says another");
  f.number("scale", scale, dimension::none, range::positive,
           "multiplies all coordinates: 0.1 for files in mm and a case in cm");
  f.check(interface.given(), "interface", "give a file, a label, or both");
  f.check(wall.empty() || wall_interface.given(), "wall_interface", "give a file, a label, or both");
  f.check(!grown_wall || outside.empty(), "outside", "is of a wall that is read; a grown one is divided by `regions`");
  f.check(!grown_wall || rings.empty(), "rings",
          "are of a wall that is read; those of a grown one are named after their openings: inlet_ring");
  f.check(!grown_wall || !wall_interface.given(), "wall_interface", "is of a wall that is read, not of a grown one");
  f.check(!grown_wall || grown_wall->regions.empty() || regions.empty(), "regions",
          "give either these or grown_wall.regions");
  f.check(!grown_wall || !needs_centreline(*grown_wall) || !centreline.empty(), "centreline",
          "is needed for a thickness by branch or radius");
  check_wall(f, !wall.empty(), grown_wall.has_value());
}

/// Files behind a way that leads out of the folder would not count for what results depend on.
void check_is_in_folder(Fields& f, const char* field, const std::string& face) {
  f.check(face.find('/') == std::string::npos, field, "must be the name of a file in mesh-surfaces, without a '/'");
}

void FolderFaceCase::declare(Fields& f) {
  f.text("face", face, "name of a file in mesh-surfaces, without .vtp", Need::required);
  check_is_in_folder(f, "face", face);
}

void MeshCompleteCase::declare(Fields& f) {
  f.path("fluid", fluid, "folder of the lumen's mesh: mesh-complete.mesh.vtu and mesh-surfaces/*.vtp", Need::required);
  f.text("interface", interface, "name of the lumen's surface toward the wall in mesh-surfaces", Need::required);
  f.groups("inlets", inlets, "of the fluid mesh, by name");
  f.groups("outlets", outlets, "of the fluid mesh, by name");
  f.path("wall", wall, "folder of the wall's mesh");
  f.text("wall_interface", wall_interface, "name of the wall's surface toward the lumen");
  f.groups("outside", outside, "regions of the outer wall, by name");
  f.groups("rings", rings, "end faces of the wall, by name");
  f.group("grown_wall", grown_wall, grown_wall_meaning);
  f.number("scale", scale, dimension::none, range::positive,
           "multiplies all coordinates: 0.1 for files in mm and a case in cm");
  check_is_in_folder(f, "interface", interface);
  check_is_in_folder(f, "wall_interface", wall_interface);
  f.check(wall.empty() || !wall_interface.empty(), "wall_interface", "must be given with wall");
  f.check(!grown_wall || !needs_centreline(*grown_wall), "grown_wall",
          "a thickness by branch or radius needs source: files, with a centreline");
  check_wall(f, !wall.empty(), grown_wall.has_value());
}

void MeshCase::declare(Fields& f) {
  f.choice("source", source,
           {{"swept", "generated: a circular tube, or swept through measured contours"},
            {"files", "meshes of other programs"},
            {"mesh_complete", "folders of SimVascular"}},
           "where the vessel comes from");
  f.when("source", source, {"swept"}, [&] { f.group("swept", swept, "a vessel generated by sweeping"); });
  f.when("source", source, {"files"}, [&] { f.group("files", files, "meshes of other programs"); });
  f.when("source", source, {"mesh_complete"},
         [&] { f.group("mesh_complete", mesh_complete, "folders of SimVascular"); });
}

}  // namespace tether
