#include "vessel/image/lumen_of_image.hpp"

#include <algorithm>
#include <cmath>

#include "vessel/image/level_set.hpp"
#include "vessel/image/neck.hpp"
#include "vessel/image/pieces.hpp"
#include "vessel/image/smooth_field.hpp"
#include "vessel/image/stops.hpp"
#include "vessel/image/zero_surface.hpp"
#include "vessel/surface/vessel_size.hpp"

namespace tether {
namespace {

constexpr double smoothing_of_labels = 1;  ///< the least that leaves of a mask's steps a tenth of a voxel [voxels]
constexpr double noted_anisotropy = 3;     // slices thicker than that hide how a vessel of some voxels' width goes on

/// 1/2 in the lumen, -1/2 outside.
ImageVolume label_field(const ImageVolume& image) {
  ImageVolume field = image;
  for (float& value : field.values) value -= 0.5F;
  return field;
}

/// How far a grey value is inside the limits.
ImageVolume threshold_field(const ImageVolume& image, const LumenImageCase& how, const ImageSummary& summary) {
  const ThresholdCase& limits = *how.threshold;
  const auto refuse = [&](const char* which, double value, const char* what) {
    return input_error("{}: {:g}: {} of {} is lumen, whose values go from {:g} to {:g}",
                       how.at(std::string("image.threshold.") + which), value, what, image.name, summary.least,
                       summary.greatest);
  };
  if (limits.above && *limits.above >= summary.greatest) throw refuse("above", *limits.above, "nothing");
  if (limits.below && *limits.below <= summary.least) throw refuse("below", *limits.below, "nothing");
  if (!limits.below && *limits.above < summary.least) throw refuse("above", *limits.above, "all");
  if (!limits.above && *limits.below > summary.greatest) throw refuse("below", *limits.below, "all");
  ImageVolume field = image;
  smooth_field(field, how.smoothing.value_or(smoothing_of_grey));
  for (float& value : field.values) {
    const double grey = value;
    value = static_cast<float>(
        std::min(limits.above ? grey - *limits.above : infinite, limits.below ? *limits.below - grey : infinite));
  }
  return field;
}

/// What a place outside the image may have been meant as.
std::string meant(const ImageVolume& image, const Vec3& place) {
  const Vec3 turned(-place[0], -place[1], place[2]);
  if (image.holds(turned)) return "; with x and y of the other sign it lies inside: is it RAS? Then image.space: ras";
  if (image.holds(place / 10)) return "; a tenth of it lies inside: is it in mm? Then [1 mm, 2 mm, 3 mm]";
  if (image.holds(turned / 10))
    return "; in mm and with x and y of the other sign it lies inside: [1 mm, 2 mm, 3 mm] and image.space: ras";
  return "";
}

/// The voxels of places that a section of the study names.
std::vector<std::size_t> voxels_at(const ImageVolume& image, const Named<Vec3>& places, const LumenImageCase& how,
                                   const std::string& section) {
  std::vector<std::size_t> voxels;
  for (const auto& [name, place] : places) {
    if (!image.holds(place))
      throw input_error("{}: {} lies outside {}, which reaches from {}{}", how.at(section + "." + name),
                        text_of_place(place), image.name, image.extent(), meant(image, place));
    voxels.push_back(image.nearest(place));
  }
  return voxels;
}

void check_seeds(const ImageVolume& image, const ImageVolume& field, const LumenImageCase& how,
                 const std::vector<std::size_t>& seeds) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (!(field.values[seeds[i]] > 0))
      throw input_error("{}: {} lies outside the lumen: the voxel there has the value {:g}{}",
                        how.at("image.seeds." + how.seeds[i].first), text_of_place(how.seeds[i].second),
                        image.values[seeds[i]],
                        how.level_set ? "; if it is the vessel's, the level set lost it: one a few voxels wide is "
                                        "kept by a threshold"
                                      : "");
}

ImageSummary summary_of(const ImageVolume& image, const LumenImageCase& how) {
  ImageSummary summary;
  summary.method = how.level_set ? ImageMethod::level_set : how.threshold ? ImageMethod::threshold : ImageMethod::label;
  summary.voxels = Vec3(image.count[0], image.count[1], image.count[2]);
  summary.voxel = image.spacing;
  summary.anisotropy = image.anisotropy();
  const auto [least, greatest] = std::minmax_element(image.values.begin(), image.values.end());
  summary.least = *least, summary.greatest = *greatest;
  return summary;
}

void set_widths(ImageSummary& summary, const Widths& widths) {
  summary.widest_radius = widths.widest.radius, summary.widest_place = widths.widest.place;
  if (!widths.neck) return;
  summary.room_radius = widths.neck->room.radius, summary.room_place = widths.neck->room.place;
  summary.door_radius = widths.neck->door.radius, summary.door_place = widths.neck->door.place;
}

/// What a person can do against a leak.
const char* mended_by(ImageMethod method) {
  return method == ImageMethod::label ? "mend the label map, or put a ball of image.stops there"
         : method == ImageMethod::threshold
             ? "put a ball of image.stops there, raise the threshold, or take a level_set"
             : "put a ball of image.stops there, name the room among image.neighbours, or bound the values by a "
               "threshold";
}

}  // namespace

LumenOfImage lumen_of(const ImageVolume& image, const LumenImageCase& how) {
  LumenOfImage result{{}, summary_of(image, how)};
  ImageSummary& summary = result.summary;
  const std::vector<std::size_t> seeds = voxels_at(image, how.seeds, how, "image.seeds");
  ImageVolume field;
  if (how.level_set) {
    LevelSet front = level_set(image, how, seeds, voxels_at(image, how.neighbours, how, "image.neighbours"));
    field = std::move(front.field);
    summary.iterations = front.iterations, summary.stood_still = front.stood_still, summary.edge = front.edge;
    summary.grew_again = front.grew_again;
  } else if (how.threshold) {
    field = threshold_field(image, how, summary);
  } else {
    field = label_field(image);
    smooth_field(field, how.smoothing.value_or(smoothing_of_labels));
  }
  cut_out(field, how.stops);
  check_seeds(image, field, how, seeds);
  const DroppedPieces dropped = keep_pieces(field, seeds);
  summary.parts_dropped = dropped.count, summary.parts_volume = dropped.volume, summary.part_place = dropped.place;
  const auto inside = std::count_if(field.values.begin(), field.values.end(), [](float value) { return value > 0; });
  summary.lumen_volume = static_cast<double>(inside) * image.spacing.prod();
  if (inside == 0) throw input_error("{}: nothing of {} is lumen once it is smoothed", how.at("image"), image.name);
  set_widths(summary, widths_of(field, seeds));
  result.surface = zero_surface(field);
  if (result.surface.triangles.empty()) throw input_error("{}: all of {} is lumen", how.at("image"), image.name);
  return result;
}

void check_width(const ImageSummary& summary, const LumenImageCase& how) {
  if (how.any_size || summary.widest_radius <= most_vessel_radius) return;
  throw input_error("{}: is {:.3g} cm wide at {}, which no vessel is: the lumen leaks, or image.unit is wrong; {}{}",
                    how.at("image"), 2 * summary.widest_radius, text_of_place(summary.widest_place),
                    mended_by(summary.method), "; image.crop bounds what is looked at");
}

std::string leak_of(const ImageSummary& s) {
  if (s.room_radius == 0) return "";
  return fmt::format(
      "behind a door of radius {:.2g} cm at {} lies a room of radius {:.2g} cm at {}: if that is not the vessel, the "
      "lumen leaks there; {}",
      s.door_radius, text_of_place(s.door_place), s.room_radius, text_of_place(s.room_place), mended_by(s.method));
}

std::string text_of(const ImageSummary& s) {
  // of a label map only whether a voxel has the label was read
  const std::string values =
      s.method == ImageMethod::label ? "" : fmt::format(", values {:g} to {:g}", s.least, s.greatest);
  std::string text = fmt::format(
      "  image: {} x {} x {} voxels of {:.3g} x {:.3g} x {:.3g} cm{}; lumen by {}, {:.4g} cm3\n", s.voxels[0],
      s.voxels[1], s.voxels[2], s.voxel[0], s.voxel[1], s.voxel[2], values, word_of(s.method), s.lumen_volume);
  text += fmt::format("  widest at {}, radius {:.3g} cm\n", text_of_place(s.widest_place), s.widest_radius);
  if (s.iterations > 0)
    text +=
        fmt::format("  {} {} iterations, at a change of {:.3g} per cm\n",
                    s.stood_still  ? "the front stood still after"
                    : s.grew_again ? "look at it: the front leaks or found a vessel without a seed, and was ended in"
                                   : "look at it: the front did not stand still in",
                    s.iterations, s.edge);
  if (const std::string leak = leak_of(s); !leak.empty()) text += "  look at it: " + leak + "\n";
  if (s.parts_dropped > 0)
    text +=
        fmt::format("  left out: {} parts that do not hang together with the lumen, {:.3g} cm3, the largest at {}\n",
                    s.parts_dropped, s.parts_volume, text_of_place(s.part_place));
  if (s.anisotropy > noted_anisotropy)
    text += fmt::format(
        "  look at it: a voxel is {:.2g} times as long as wide; above {:g} the surface between slices is a guess\n",
        s.anisotropy, noted_anisotropy);
  return text;
}

}  // namespace tether
