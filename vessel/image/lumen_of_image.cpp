#include "vessel/image/lumen_of_image.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "vessel/image/level_set.hpp"
#include "vessel/image/pieces.hpp"
#include "vessel/image/smooth_field.hpp"
#include "vessel/image/zero_surface.hpp"

namespace tether {
namespace {

// The least that leaves a tube's surface smooth to a tenth of a voxel: of a mask's steps, of noise a tenth of the
// contrast.
constexpr double smoothing_of_labels = 1, smoothing_of_grey = 0.7;  // [voxels]
constexpr double noted_anisotropy = 3;  // slices thicker than that hide how a vessel of some voxels' width goes on

std::string listed_labels(const ImageVolume& image) {
  constexpr std::size_t most_told = 20;
  std::set<float> labels;
  for (const float value : image.values)
    if (value != 0 && labels.size() <= most_told) labels.insert(value);
  std::string text;
  for (const float label : labels)
    text += labels.size() > most_told && label == *labels.rbegin()
                ? ", ..."
                : fmt::format("{}{:g}", text.empty() ? "" : ", ", label);
  return text;
}

/// 1/2 in the lumen, -1/2 outside.
ImageVolume label_field(const ImageVolume& image, const LumenImageCase& how) {
  ImageVolume field = image;
  bool any = false;
  for (float& value : field.values) {
    if (value != std::round(value))
      throw input_error("{}: {}: {} is no label map: it has the value {:g}", how.at("image.label"), how.label,
                        image.name, value);
    const bool inside = value == static_cast<float>(how.label);
    any = any || inside;
    value = inside ? 0.5F : -0.5F;
  }
  if (any) return field;
  const std::string there = listed_labels(image);
  throw input_error("{}: {}: {}", how.at("image.label"), how.label,
                    there.empty() ? image.name + " is empty: all of it is 0"
                                  : fmt::format("is not in {}, which has {}", image.name, there));
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

std::vector<std::size_t> seeds_in(const ImageVolume& image, const LumenImageCase& how) {
  std::vector<std::size_t> voxels;
  for (const auto& [name, place] : how.seeds) {
    if (!image.holds(place))
      throw input_error("{}: {} lies outside {}, which reaches from {}", how.at("image.seeds." + name),
                        text_of_place(place), image.name, image.extent());
    voxels.push_back(image.nearest(place));
  }
  return voxels;
}

void check_seeds(const ImageVolume& image, const ImageVolume& field, const LumenImageCase& how,
                 const std::vector<std::size_t>& seeds) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (!(field.values[seeds[i]] > 0))
      throw input_error("{}: {} lies outside the lumen: the voxel there has the value {:g}",
                        how.at("image.seeds." + how.seeds[i].first), text_of_place(how.seeds[i].second),
                        image.values[seeds[i]]);
}

ImageSummary summary_of(const ImageVolume& image, const LumenImageCase& how) {
  ImageSummary summary;
  summary.method = how.threshold ? ImageMethod::threshold : how.level_set ? ImageMethod::level_set : ImageMethod::label;
  summary.voxels = Vec3(image.count[0], image.count[1], image.count[2]);
  summary.voxel = image.spacing;
  summary.anisotropy = image.anisotropy();
  const auto [least, greatest] = std::minmax_element(image.values.begin(), image.values.end());
  summary.least = *least, summary.greatest = *greatest;
  return summary;
}

}  // namespace

LumenOfImage lumen_of(const ImageVolume& image, const LumenImageCase& how) {
  LumenOfImage result{{}, summary_of(image, how)};
  ImageSummary& summary = result.summary;
  const std::vector<std::size_t> seeds = seeds_in(image, how);
  ImageVolume field;
  if (how.threshold) {
    field = threshold_field(image, how, summary);
  } else if (how.level_set) {
    LevelSet front = level_set(image, how, seeds);
    field = std::move(front.field), summary.iterations = front.iterations, summary.edge = front.edge;
  } else {
    field = label_field(image, how);
    smooth_field(field, how.smoothing.value_or(smoothing_of_labels));
  }
  check_seeds(image, field, how, seeds);
  const DroppedPieces dropped = keep_pieces(field, seeds);
  summary.parts_dropped = dropped.count, summary.parts_volume = dropped.volume, summary.part_place = dropped.place;
  const auto inside = std::count_if(field.values.begin(), field.values.end(), [](float value) { return value > 0; });
  summary.lumen_volume = static_cast<double>(inside) * image.spacing.prod();
  result.surface = zero_surface(field);
  if (result.surface.triangles.empty())
    throw input_error("{}: nothing of {} is lumen once it is smoothed", how.at("image"), image.name);
  return result;
}

std::string text_of(const ImageSummary& s) {
  std::string text = fmt::format(
      "  image: {} x {} x {} voxels of {:.3g} x {:.3g} x {:.3g} cm, values {:g} to {:g}; lumen by {}, {:.4g} cm3\n",
      s.voxels[0], s.voxels[1], s.voxels[2], s.voxel[0], s.voxel[1], s.voxel[2], s.least, s.greatest, word_of(s.method),
      s.lumen_volume);
  if (s.iterations > 0)
    text += fmt::format("  the front stood still after {} iterations, at a change of {:.3g} per cm\n", s.iterations,
                        s.edge);
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
