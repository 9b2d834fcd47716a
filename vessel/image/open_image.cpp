#include "vessel/image/open_image.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "vessel/image/image_file.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {
namespace {

using Voxel = std::array<int, 3>;

/// The same image by coordinates whose x and y point the other way.
void turn_about_z(ImageVolume& image) {
  const Vec3 sign(-1, -1, 1);
  image.origin = sign.cwiseProduct(image.origin);
  image.axes = sign.asDiagonal() * image.axes;
}

ImageVolume part_of(const ImageVolume& image, const Voxel& low, const Voxel& high) {
  ImageVolume part{image.name, {}, image.place(Vec3(low[0], low[1], low[2])), image.spacing, image.axes, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) part.count[axis] = high[axis] - low[axis] + 1;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const auto first = image.values.begin() + static_cast<std::ptrdiff_t>(image.at(low[0], j, k));
      part.values.insert(part.values.end(), first, first + part.count[0]);
    }
  return part;
}

/// The voxels about a box.
ImageVolume cropped(const ImageVolume& image, const CropCase& box, const std::string& field) {
  Vec3 low = Vec3::Constant(infinite), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = corner >> axis & 1 ? box.high[axis] : box.low[axis];
    low = low.cwiseMin(image.index(x)), high = high.cwiseMax(image.index(x));
  }
  Voxel first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    first[axis] = static_cast<int>(std::ceil(std::max(low[i], 0.0)));
    last[axis] = static_cast<int>(std::floor(std::min(high[i], image.count[axis] - 1.0)));
    if (last[axis] - first[axis] < 2)
      throw input_error("{}: leaves less than three voxels along an axis of {}, which reaches from {}", field,
                        image.name, image.extent());
  }
  return part_of(image, first, last);
}

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

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// 1 where a voxel has one of the labels, each of which must be there.
void mark(ImageVolume& image, const LumenImageCase& how) {
  std::set<float> asked, found;
  for (const std::string& label : how.labels) asked.insert(std::stof(label));
  for (const float value : image.values) {
    if (value != std::round(value))
      throw input_error("{}: {} is no label map: it has the value {:g}", how.at("image.labels"), image.name, value);
    if (asked.contains(value)) found.insert(value);
  }
  for (const float label : asked)
    if (!found.contains(label)) {
      const std::string there = listed_labels(image);
      throw input_error("{}: {:g}: {}", how.at("image.labels"), label,
                        there.empty() ? image.name + " is empty: all of it is 0"
                                      : fmt::format("is not in {}, which has {}", image.name, there));
    }
  for (float& value : image.values) value = asked.contains(value) ? 1 : 0;
}

}  // namespace

ImageVolume open_image(const LumenImageCase& how) {
  const double cm = in_cm(how.unit);
  const bool by_value = std::all_of(how.labels.begin(), how.labels.end(), is_number);
  ImageVolume image =
      by_value ? read_image(how.file, cm) : read_segments(how.file, cm, how.labels, how.at("image.labels"));
  if (how.space == "ras") turn_about_z(image);
  if (how.crop) image = cropped(image, *how.crop, how.at("image.crop"));
  if (by_value && !how.labels.empty()) mark(image, how);
  return image;
}

}  // namespace tether
