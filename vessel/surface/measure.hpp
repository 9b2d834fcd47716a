#pragma once

#include "vessel/surface/surface.hpp"

namespace tether {

/// What a surface is, and how far from the one that it was made of.
struct SurfaceMeasures {
  static constexpr const char* type_name = "surface_measures";
  int points = 0, triangles = 0;
  double wall_area = 0, volume = 0, mean_edge = 0, least_angle = 0, least_angle_of_100 = 0;

  static void fields(auto& self, auto&& field) {
    field("points", self.points, "");
    field("triangles", self.triangles, "caps included");
    field("wall_area", self.wall_area, "[cm2]");
    field("volume", self.volume, "[cm3]");
    field("mean_edge", self.mean_edge, "[cm]");
    field("least_angle", self.least_angle, "of any triangle [degrees]");
    field("least_angle_of_100", self.least_angle_of_100, "one triangle in a hundred has a smaller one [degrees]");
  }
};
SurfaceMeasures measures_of(const LabelledSurface& surface);

/// How far a surface is from another, both ways, at nodes and middles of triangles.
struct SurfaceDistance {
  static constexpr const char* type_name = "surface_distance";
  double mean = 0, p95 = 0, greatest = 0;

  static void fields(auto& self, auto&& field) {
    field("mean", self.mean, "[cm]");
    field("p95", self.p95, "95 of 100 places are nearer [cm]");
    field("greatest", self.greatest, "[cm]");
  }
};
SurfaceDistance distance_between(const LabelledSurface& a, const LabelledSurface& b);

}  // namespace tether
