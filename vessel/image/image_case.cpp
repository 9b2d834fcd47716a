#include "vessel/image/image_case.hpp"

namespace tether {

void CropCase::declare(Fields& f) {
  f.point("low", low, dimension::length, "corner with the smallest coordinates");
  f.point("high", high, dimension::length, "corner with the largest coordinates");
  f.check((low.array() < high.array()).all(), "low", "must be below high along each axis");
}

void ThresholdCase::declare(Fields& f) {
  f.number("above", above, dimension::none, range::any, "grey value from which on a place is lumen");
  f.number("below", below, dimension::none, range::any, "grey value up to which a place is lumen");
  f.check(above || below, "above", "or below must be given");
  f.check(!above || !below || *above < *below, "above", "must be less than below");
}

void LevelSetCase::declare(Fields& f) {
  f.number("edge", edge, dimension::none, range::positive,
           "change of grey values at the wall, per cm; default: found from the seeds outward");
  f.number("curvature", curvature, dimension::none, {0, 1},
           "of the front, that it resists: keeps it from noise and small gaps, and from the narrowest vessels");
  f.integer("iterations", iterations, {1, 100000}, "at most, until the front stands still");
}

void StopCase::declare(Fields& f) {
  f.point("point", point, dimension::length, "its middle");
  f.number("radius", radius, dimension::length, range::positive, "");
}

void LumenImageCase::declare(Fields& f) {
  f.path("file", file, ".mha, .mhd, .nrrd, .seg.nrrd, .nhdr, .nii or .nii.gz", Need::required);
  f.choice("unit", unit, {{"mm", "the header's lengths are millimetres"}, {"cm", "centimetres"}, {"m", "metres"}},
           "of the header's lengths");
  f.choice("space", space,
           {{"lps", "x to the patient's left, y to the back, z to the head, as in DICOM and ITK"},
            {"ras", "x to the right, y to the front, z to the head, as 3D Slicer shows places"}},
           "of all coordinates of this study and of the model, whatever the file's own are");
  f.group("crop", crop, "only this part of the image is looked at, whole voxels; where the lumen leaves it is an end");
  f.texts("labels", labels,
          "the file is a label map, and these values, or segments of these names in a .seg.nrrd, are the lumen");
  f.group("threshold", threshold, "grey values tell the lumen; with a level_set, where its front may go");
  f.group("level_set", level_set, "a front that grows from the seeds until grey values change tells the lumen");
  f.points("seeds", seeds, dimension::length,
           "places inside the lumen, by any name: what does not hang together with one is left out; without seeds, all "
           "but the largest part");
  f.points("neighbours", neighbours, dimension::length,
           "with a level_set, places inside what touches the lumen, by any name: a vein, the pulmonary artery, bone");
  f.groups("stops", stops, "balls that are not lumen, by any name, where it would go on into what is not wanted");
  f.number("smoothing", smoothing, dimension::none, {0, 5},
           "deviation of the Gaussian against noise and steps, in voxels; default 1, with a threshold 0.7");
  f.flag("any_size", any_size, "do not refuse openings that no vessel has, which mostly mean a wrong unit");
  f.check(labels.empty() == (threshold || level_set), "labels",
          "or threshold or level_set must be given: labels, or one of the others, or both of these");
  f.check(!level_set || !seeds.empty(), "seeds", "must be given with a level_set");
  f.check(level_set || neighbours.empty(), "neighbours", "are for a level_set");
}

std::string LumenImageCase::at(std::string field) const {
  for (std::string known = field;;) {
    if (const auto line = lines.find(known); line != lines.end()) return line->second + ": " + field;
    const auto dot = known.rfind('.');
    if (dot == std::string::npos) return field;
    known.resize(dot);
  }
}

}  // namespace tether
