#pragma once

#include <functional>

#include "vessel/centreline/tree.hpp"
#include "vessel/image/image_volume.hpp"
#include "vessel/study/study_case.hpp"
#include "vessel/study/surface_summary.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// A lumen ready to be meshed.
struct BuiltSurface {
  LabelledSurface surface;
  CentrelineTree tree;
  SurfaceSummary summary;
  std::optional<ImageVolume> image;  ///< that it was found in, if it was
};

/// A step's result on its way: its name, "1_repaired", and the surface then.
using StepSeen = std::function<void(const std::string& step, const RawSurface&)>;

/// The image of a study, and the lumen that was found in it.
using ImageSeen = std::function<void(const ImageVolume&, const RawSurface&)>;

/// Reads (a surface, or an image and finds the lumen in it), repairs, opens, smooths, closes by flat caps, finds
/// centrelines, and makes triangles anew, as the study says. Throws InputError for a surface or study that is wrong,
/// PlacedError where that has a place.
BuiltSurface build_surface(const StudyCase& study, const StepSeen& seen = {}, const ImageSeen& image_seen = {});

/// What a person is told of it.
std::string text_of(const SurfaceSummary& summary);

}  // namespace tether
