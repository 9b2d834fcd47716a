#include "vessel/image/image_case.hpp"

namespace tether {

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

void LumenImageCase::declare(Fields& f) {
  f.path("file", file, ".mha, .mhd, .nrrd, .nhdr, .nii or .nii.gz; its places are the patient's (x left, y back, z up)",
         Need::required);
  f.choice("unit", unit, {{"mm", "the header's lengths are millimetres"}, {"cm", "centimetres"}, {"m", "metres"}},
           "of the header's lengths");
  f.integer("label", label, {0}, "the file is a label map, and this value the lumen; 0: not said");
  f.group("threshold", threshold, "grey values tell the lumen");
  f.group("level_set", level_set, "a front that grows from the seeds until grey values change tells the lumen");
  f.points("seeds", seeds, dimension::length,
           "places inside the lumen, by any name: what does not hang together with one is left out; without seeds, all "
           "but the largest part");
  f.number("smoothing", smoothing, dimension::none, {0, 5},
           "deviation of the Gaussian against noise and steps, in voxels; default 1, with a threshold 0.7");
  f.flag("any_size", any_size, "do not refuse openings that no vessel has, which mostly mean a wrong unit");
  f.check((label > 0) + threshold.has_value() + level_set.has_value() == 1, "label",
          "or threshold or level_set must be given, one of them");
  f.check(!level_set || !seeds.empty(), "seeds", "must be given with a level_set");
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
