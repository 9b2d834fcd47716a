#pragma once

#include <functional>

#include "vessel/centreline/tree.hpp"
#include "vessel/study/study_case.hpp"
#include "vessel/study/surface_summary.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// A lumen ready to be meshed.
struct BuiltSurface {
  LabelledSurface surface;
  CentrelineTree tree;
  SurfaceSummary summary;
};

/// A step's result on its way: its name, "1_repaired", and the surface then.
using StepSeen = std::function<void(const std::string& step, const RawSurface&)>;

/// Reads, repairs, opens, smooths, closes by flat caps, finds centrelines, and makes triangles anew, as the study says.
/// Throws InputError for a surface or study that is wrong, PlacedError where that has a place.
BuiltSurface build_surface(const StudyCase& study, const StepSeen& seen = {});

/// What a person is told of it.
std::string text_of(const SurfaceSummary& summary);

}  // namespace tether
