#pragma once

#include <string>
#include <vector>

#include "common/base/placed_error.hpp"
#include "common/io/record.hpp"

namespace tether {

/// A surface as it is on its way to a lumen: open or closed.
struct RawSurface {
  Points points;                    ///< [cm]
  std::vector<Triangle> triangles;  ///< outward once oriented
  std::vector<int> face_id;         ///< per triangle: the file's label, 0 where it has none
};

/// How many cm the word for a unit of length is: "mm", "cm", "m".
double in_cm(const std::string& unit);

/// "(1.2, 3.4, 5.6) cm"
std::string text_of_place(const Vec3& place);

enum class RepairKind {
  points_merged,
  triangles_dropped,
  fins_dropped,
  pieces_dropped,
  points_split,
  triangles_turned,
  slivers_removed,
  crossings_removed,
  holes_filled,
  caps_found,
  rims_flattened,
  rims_cut,
};
template <>
inline constexpr std::array words_of<RepairKind>{
    WordOf<RepairKind>{RepairKind::points_merged, "points_merged", "points at the same place made one"},
    WordOf<RepairKind>{RepairKind::triangles_dropped, "triangles_dropped",
                       "without area by their nodes, or given twice"},
    WordOf<RepairKind>{RepairKind::fins_dropped, "fins_dropped",
                       "walls inside or outside that hang on an edge of three triangles"},
    WordOf<RepairKind>{RepairKind::pieces_dropped, "pieces_dropped", "pieces not connected with the largest"},
    WordOf<RepairKind>{RepairKind::points_split, "points_split", "points at which two parts only touched"},
    WordOf<RepairKind>{RepairKind::triangles_turned, "triangles_turned", "triangles that looked inward"},
    WordOf<RepairKind>{RepairKind::slivers_removed, "slivers_removed", "triangles much longer than wide"},
    WordOf<RepairKind>{RepairKind::crossings_removed, "crossings_removed",
                       "triangles that crossed others, cut out and closed anew"},
    WordOf<RepairKind>{RepairKind::holes_filled, "holes_filled", "small rims closed"},
    WordOf<RepairKind>{RepairKind::caps_found, "caps_found", "flat ends found and taken for openings"},
    WordOf<RepairKind>{RepairKind::rims_flattened, "rims_flattened", "rims moved onto their plane"},
    WordOf<RepairKind>{RepairKind::rims_cut, "rims_cut", "rims that were not flat, cut a little inward"}};

/// Something that was done to a surface.
struct RepairNote {
  static constexpr const char* type_name = "repair_note";
  RepairKind kind = RepairKind::points_merged;
  int count = 0;
  Vec3 place = Vec3::Zero();
  double size = 0;

  static void fields(auto& self, auto&& field) {
    field("kind", self.kind, "what was done");
    field("count", self.count, "how many of what the kind says");
    field("place", self.place, "of one of them [cm]");
    field("size", self.size, "area of what was dropped or filled [cm2], greatest shift of a rim [cm]; 0 elsewhere");
  }
};

/// A sentence of it, with its place.
std::string text_of(const RepairNote& note);

/// A surface under repair, and what was done to it.
struct Repaired {
  RawSurface surface;
  std::vector<RepairNote> notes;
};

}  // namespace tether
