#pragma once

#include <array>
#include <filesystem>

#include "vessel/centreline/tree.hpp"
#include "vessel/extrude.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/model/model_quality.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// The volume side of a study: what is made of a clean surface.
struct VolumeCase {
  std::optional<double> longest_edge;
  GrownWallCase wall;
  Named<GeometricRegionCase> regions;
  void declare(Fields& f);
};

/// A vessel ready to be run, how its wall grew, and how good its meshes are.
struct VesselModel {
  VesselMesh mesh;
  GrownWall growth;  ///< its mesh is in `mesh`
  ModelQuality quality;
};

/// Fills the lumen, grows the wall, divides it, looks at the result. The surface's and the tree's lengths are those of
/// `units`. Throws InputError with the place of what cannot be meshed.
VesselModel build_model(const LabelledSurface& surface, const CentrelineTree& tree, const VolumeCase& study,
                        const UnitSystem& units);

/// What write_model writes; the case last.
inline constexpr std::array model_files{"quality.json", "lumen.vtu",      "lumen_faces.vtu",
                                        "wall.vtu",     "wall_faces.vtu", "centreline.csv",
                                        "objects.csv",  "flow.csv",       "case.yaml"};

/// Writes FOLDER/lumen.vtu, lumen_faces.vtu, wall.vtu (with the arrays asked_thickness and thickness), wall_faces.vtu,
/// centreline.csv, objects.csv (curves that regions refer to), quality.json, and case.yaml with flow.csv: a case of
/// that name that runs (see `ready_case`). Throws RunError.
void write_model(const std::filesystem::path& folder, const std::string& name, const VesselModel& model,
                 const CentrelineTree& tree, const VolumeCase& study, const UnitSystem& units);

/// Removes what write_model wrote, and the folder if nothing else is in it. Files beside no quality.json are others'.
void remove_model(const std::filesystem::path& folder);

}  // namespace tether
