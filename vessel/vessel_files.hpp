#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "vessel/anatomy/region_rule.hpp"
#include "vessel/extrude.hpp"
#include "vessel/regions.hpp"

namespace tether {

/// Where the triangles of a face are: all of a file, those of a file that carry a label, or (without file) those of the
/// volume's file.
struct FaceSource {
  std::filesystem::path file;    ///< its nodes are found in the volume by GlobalNodeID, else by position
  std::string label;             ///< an integer of the label array, or the name or number of a Gmsh physical group
  std::string label_array = {};  ///< that the label refers to; none: that of the vessel
  std::string where = {};        ///< that the user named it, for messages: "case.yaml:9: mesh.files.inlets.inlet"
  bool given() const { return !file.empty() || !label.empty(); }
};
using NamedFaces = std::vector<std::pair<std::string, FaceSource>>;

/// A vessel in files made by other programs.
struct VesselFiles {
  std::filesystem::path fluid, wall;  ///< no wall: it is extruded from the interface
  FaceSource interface, wall_interface;
  NamedFaces inlets, outlets;
  NamedFaces outside, rings;
  std::string label_array = "ModelFaceID";
  double scale = 1;    ///< multiplies all coordinates
  bool prisms = true;  ///< tetrahedra of the wall are put together to prisms; else prisms are cut into tetrahedra
  ExtrusionSettings extrusion;  ///< without wall
  /// Of an extruded wall, about the straight line from the inlet's to the outlet's centre: for tubes only.
  std::vector<WallRegion> regions;
  std::string regions_field = "mesh.files.grown_wall.regions";  ///< for messages, with its line if known
  Vec3 angle_origin{1, 0, 0};
  std::shared_ptr<const Anatomy> anatomy;  ///< that rules refer to
  std::vector<RegionRule> rules;           ///< divide all of the outside, anew; none: it stays as it is
};

/// A vessel, and how its wall was grown where it was.
struct ReadVessel {
  VesselMesh mesh;
  std::optional<GrownWall> growth;  ///< its mesh is in `mesh`
};

/// Reads, matches and renumbers; tetrahedra that are all inverted are turned. Throws InputError naming file and place.
/// The result still has to pass `check`.
ReadVessel read_vessel_and_growth(const VesselFiles& files);
VesselMesh read_vessel(const VesselFiles& files);

}  // namespace tether
