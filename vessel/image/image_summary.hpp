#pragma once

#include "common/base/types.hpp"
#include "common/io/record.hpp"

namespace tether {

enum class ImageMethod { label, threshold, level_set };
template <>
inline constexpr std::array words_of<ImageMethod>{
    WordOf<ImageMethod>{ImageMethod::label, "label", "voxels with a label"},
    WordOf<ImageMethod>{ImageMethod::threshold, "threshold", "grey values above or below a limit"},
    WordOf<ImageMethod>{ImageMethod::level_set, "level_set", "a front that stops where grey values change"}};

/// What an image was, and what of it was taken for lumen.
struct ImageSummary {
  static constexpr const char* type_name = "image_summary";
  ImageMethod method = ImageMethod::label;
  Vec3 voxels = Vec3::Zero(), voxel = Vec3::Zero();
  double least = 0, greatest = 0, anisotropy = 1, lumen_volume = 0;
  int parts_dropped = 0, iterations = 0;
  bool stood_still = true, grew_again = false;
  double parts_volume = 0, edge = 0, widest_radius = 0, door_radius = 0, room_radius = 0;
  Vec3 part_place = Vec3::Zero(), widest_place = Vec3::Zero(), door_place = Vec3::Zero(), room_place = Vec3::Zero();

  static void fields(auto& self, auto&& field) {
    field("method", self.method, "by which the lumen was told");
    field("voxels", self.voxels, "along each axis");
    field("voxel", self.voxel, "size of one along each axis [cm]");
    field("anisotropy", self.anisotropy, "longest over shortest side of a voxel");
    field("least", self.least, "value");
    field("greatest", self.greatest, "value");
    field("lumen_volume", self.lumen_volume, "of the voxels taken [cm3]");
    field("parts_dropped", self.parts_dropped, "that are like the lumen, but do not hang together with it");
    field("parts_volume", self.parts_volume, "of all of these [cm3]");
    field("part_place", self.part_place, "a place in the largest of them [cm]");
    field("widest_radius", self.widest_radius, "of the largest sphere in the lumen [cm]");
    field("widest_place", self.widest_place, "its middle [cm]");
    field("room_radius", self.room_radius,
          "of the largest sphere in a part that is reached through a door at most half as wide; 0: there is none [cm]");
    field("room_place", self.room_place, "its middle [cm]");
    field("door_radius", self.door_radius, "of that door [cm]");
    field("door_place", self.door_place, "[cm]");
    field("iterations", self.iterations, "of the front; 0 without a level set");
    field("stood_still", self.stood_still, "whether the front did so before the iterations were used up");
    field("grew_again", self.grew_again,
          "whether it was ended since it grew faster again: it leaks, or found a vessel that no seed lies in");
    field("edge", self.edge, "change of grey values per cm at which the front stops; 0 without a level set");
  }
};

/// Where the lumen may have leaked, and what mends that; empty: nothing looks like it.
std::string leak_of(const ImageSummary& summary);

/// What a person is told of it.
std::string text_of(const ImageSummary& summary);

}  // namespace tether
