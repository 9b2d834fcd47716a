#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "common/io/record.hpp"

namespace tether {

/// Shape of the blood's tetrahedra.
struct TetrahedraQuality {
  static constexpr const char* type_name = "tetrahedra_quality";
  int nodes = 0, elements = 0;
  double volume = 0, least_radius_ratio = 0, mean_radius_ratio = 0, least_dihedral = 0;
  Vec3 worst_place = Vec3::Zero();

  static void fields(auto& self, auto&& field) {
    field("nodes", self.nodes, "");
    field("elements", self.elements, "tetrahedra");
    field("volume", self.volume, "of the lumen, in the unit of length cubed");
    field("least_radius_ratio", self.least_radius_ratio,
          "three times the inscribed over the circumscribed radius: 1 for a regular tetrahedron");
    field("mean_radius_ratio", self.mean_radius_ratio, "");
    field("least_dihedral", self.least_dihedral, "angle between two faces [degrees]");
    field("worst_place", self.worst_place, "of the least radius ratio");
  }
};

/// Shape of the wall's prisms.
struct PrismsQuality {
  static constexpr const char* type_name = "prisms_quality";
  int nodes = 0, elements = 0, layers = 0;
  double volume = 0, least_jacobian = 0;
  Vec3 worst_place = Vec3::Zero();

  static void fields(auto& self, auto&& field) {
    field("nodes", self.nodes, "");
    field("elements", self.elements, "prisms");
    field("layers", self.layers, "of prisms");
    field("volume", self.volume, "of the wall, in the unit of length cubed");
    field("least_jacobian", self.least_jacobian,
          "det T of M.1: 1 where the layers stand upright at the thickness that they have, 0 or less where they fold");
    field("worst_place", self.worst_place, "of the least Jacobian");
  }
};

/// How thick the wall came out.
struct ThicknessQuality {
  static constexpr const char* type_name = "thickness_quality";
  double least_asked = 0, most_asked = 0, least = 0, mean = 0, most = 0, least_share = 1, thinner_area = 0;
  Vec3 thinnest_place = Vec3::Zero();
  int moved_nodes = 0;

  static void fields(auto& self, auto&& field) {
    field("least_asked", self.least_asked, "");
    field("most_asked", self.most_asked, "");
    field("least", self.least, "distance of an outer node to the lumen");
    field("mean", self.mean, "over nodes");
    field("most", self.most, "");
    field("least_share", self.least_share, "the least thickness over what was asked there");
    field("thinner_area", self.thinner_area, "of the lumen where the wall is more than 5 % thinner than asked");
    field("thinnest_place", self.thinnest_place, "of the least share");
    field("moved_nodes", self.moved_nodes, "outer nodes that do not stand straight above their own: in crotches");
  }
};

struct RegionArea {
  static constexpr const char* type_name = "region_area";
  std::string name;
  double area = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "");
    field("area", self.area, "of the outer wall, exact");
  }
};

/// What a person wants to know of a model's meshes: quality.json.
struct ModelQuality {
  static constexpr const char* type_name = "model_quality";
  std::string unit;
  TetrahedraQuality blood;
  PrismsQuality wall;
  ThicknessQuality thickness;
  std::vector<RegionArea> regions;
  std::vector<std::string> warnings;

  static void fields(auto& self, auto&& field) {
    field("unit", self.unit, "of length");
    field("blood", self.blood, "");
    field("wall", self.wall, "");
    field("thickness", self.thickness, "of the wall");
    field("regions", self.regions, "of the outer wall");
    field("warnings", self.warnings, "what a person should look at");
  }
};

}  // namespace tether
