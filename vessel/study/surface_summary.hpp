#pragma once

#include <optional>

#include "vessel/image/image_summary.hpp"
#include "vessel/surface/measure.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

struct BuiltOpening {
  static constexpr const char* type_name = "built_opening";
  std::string name;
  int label = 0;
  Vec3 centre = Vec3::Zero(), outward = Vec3::Zero();
  double area = 0, radius = 0;
  bool at_image_border = false;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "");
    field("label", self.label, "of its triangles in surface.vtp");
    field("centre", self.centre, "[cm]");
    field("outward", self.outward, "unit normal");
    field("area", self.area, "[cm2]");
    field("radius", self.radius, "of the circle with that area [cm]");
    field("at_image_border", self.at_image_border, "whether it is where the lumen leaves the image");
  }
};

struct BuiltBranch {
  static constexpr const char* type_name = "built_branch";
  std::string name, parent;
  double length = 0, mean_radius = 0, least_radius = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the opening that it leads to");
    field("parent", self.parent, "the branch that it leaves; empty: it is the trunk");
    field("length", self.length, "of its line [cm]");
    field("mean_radius", self.mean_radius, "of the largest spheres inside [cm]");
    field("least_radius", self.least_radius, "[cm]");
  }
};

/// surface.json: what became of a surface.
struct SurfaceSummary {
  static constexpr const char* type_name = "surface_summary";
  std::string study, file;
  std::optional<ImageSummary> image;
  std::vector<RepairNote> repairs;
  double smoothing_volume_change = 0, remeshing_volume_change = 0, remeshing_area_change = 0;
  std::string inlet;
  std::vector<BuiltOpening> openings;
  std::vector<BuiltBranch> branches;
  SurfaceMeasures surface;
  SurfaceDistance distance;

  static void fields(auto& self, auto&& field) {
    field("study", self.study, "its name");
    field("file", self.file, "the surface or image that was given");
    field("image", self.image, "null: a surface was given");
    field("repairs", self.repairs, "what was done to it, in that order");
    field("smoothing_volume_change", self.smoothing_volume_change, "as a fraction");
    field("remeshing_volume_change", self.remeshing_volume_change, "as a fraction");
    field("remeshing_area_change", self.remeshing_area_change, "of the wall, as a fraction");
    field("inlet", self.inlet, "the opening that blood enters");
    field("openings", self.openings, "");
    field("branches", self.branches, "the trunk first");
    field("surface", self.surface, "as it came out");
    field("distance", self.distance, "between it and the surface before its triangles were made anew");
  }
};

}  // namespace tether
