#pragma once

#include <string>
#include <vector>

#include "common/observation/lumen_surface.hpp"
#include "common/observation/surface_series.hpp"

namespace tether {

/// A measured surface made fit for distances, and one line for each thing that was found or done.
struct CheckedSurface {
  TriangleSurface surface;
  std::vector<bool> flawed;  ///< triangles that others pass through
  std::vector<std::string> notes;
};

/// Equal points become one; triangles without area, and loose pieces below a twentieth of the whole area, are left out;
/// a surface whose normals all look inward is turned; all of that is noted, and so are holes and self-intersections.
/// Throws InputError, beginning with `name`: no triangles, an edge with more than two triangles, normals that disagree
/// between neighbours, self-intersections in more than a hundredth of the triangles.
CheckedSurface checked_surface(const std::string& name, TriangleSurface surface);

/// Throws InputError if no node of the imaged lumen has its closest place on the frame's surface within `reach`: the
/// data are elsewhere, or in another unit.
void check_overlap(const std::string& name, const TriangleSurface& surface, const LumenSurface& lumen, double reach);

/// Where the model's box and the data's box do not fit together: both of them, and the factor that would make them
/// equally large if it is a power of ten.
std::string placement(const Points& data, const Points& model);

}  // namespace tether
