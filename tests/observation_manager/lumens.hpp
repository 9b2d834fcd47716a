#pragma once

#include <fmt/format.h>

#include <string>

#include "observation_manager/measurements/lumen_series.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"
#include "tests/observation_manager/shapes.hpp"

namespace tether::testing {

/// A surface as the lumen of a model: one region, ends far away.
inline LumenSurface lumen(const TriangleSurface& surface) {
  LumenSurface result;
  result.points = surface.points;
  result.triangles = surface.triangles;
  result.region_names = {"all"};
  result.region.assign(static_cast<std::size_t>(surface.points.cols()), 0);
  result.from_inlet = result.from_outlet = VectorXd::Constant(surface.points.cols(), 1e9);
  return result;
}

inline SourceSettings settings_for(const LumenSurface& lumen) {
  SourceSettings settings;
  settings.name = "data";
  settings.of_node.assign(lumen.region.size(), Exclusion::none);
  settings.region = lumen.region;
  return settings;
}

inline TriangleSurface scaled(TriangleSurface surface, double factor) {
  surface.points *= factor;
  return surface;
}

/// As an ASCII file.
inline std::string stl_text(const TriangleSurface& surface) {
  std::string text = "solid s\n";
  for (const Triangle& t : surface.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int node : t)
      text +=
          fmt::format("vertex {} {} {}\n", surface.points(0, node), surface.points(1, node), surface.points(2, node));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

}  // namespace tether::testing
