#pragma once

#include <span>

#include "observation_manager/measurements/observations.hpp"
#include "observation_manager/measurements/registry.hpp"

namespace tether {

/// A kind whose sources are read by VTK or measured by CGAL, and how.
struct LumenKind {
  const MeasurementKind& kind;
  /// Throws InputError that names the file, or the field of the case.
  void (*load)(const KindSection& section, const LumenSurface& lumen, const CaseFile& file, Observations& to);
};

void load_surfaces(const KindSection& section, const LumenSurface& lumen, const CaseFile& file, Observations& to);
void load_contours(const KindSection& section, const LumenSurface& lumen, const CaseFile& file, Observations& to);

std::span<const LumenKind> lumen_kinds();

}  // namespace tether
