#pragma once

#include <string>
#include <vector>

#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/surface_series.hpp"

namespace tether {

/// A measured surface made fit for distances, and one line for each thing that was found or done.
struct CheckedSurface {
  TriangleSurface surface;
  std::vector<bool> flawed;  ///< triangles that others pass through
  std::vector<std::string> notes;
};

/// Equal points become one; points far from all others, triangles without area, and loose pieces below a twentieth of
/// the whole area are left out, never the largest;
/// pieces whose normals look inward are turned; all of that is noted, and so are holes and self-intersections.
/// Throws InputError, beginning with `name`: no triangles, an edge with more than two triangles, normals that disagree
/// between neighbours, open edges that fork, small pieces with more than half of the area, self-intersections in more
/// than a hundredth of the triangles.
CheckedSurface checked_surface(const std::string& name, TriangleSurface surface);

/// Volume in a surface, each of its `holes` closed by a fan about its middle; negative if normals look inward
/// [length^3].
double enclosed_volume(const TriangleSurface& surface, const std::vector<std::vector<int>>& holes);

/// How a measured surface lies about the imaged lumen. A place of the lumen is faced if what is closest to it is not
/// the surface's rim.
struct Placing {
  double faced;    ///< share of the lumen's nodes
  double near;     ///< of those faced, the share within reach of the surface and looking the same way, to 60 degrees
  double opposed;  ///< of those faced, the share within reach where the surface's normal looks against the lumen's
};
Placing placing_of(const TriangleSurface& surface, const LumenSurface& lumen, double reach);

/// The diagonal of the box around some points [length].
double box_size(const Points& x);

/// The power of ten that a ratio of two sizes is close to (within a factor 2.2), 0 also if it is close to none.
int power_of_ten(double ratio);

/// "about 10 times larger than the model: is its unit mm, not cm?"
std::string guessed_unit(int power, const std::string& stated);

/// Where the model's box and the data's box do not fit together: both of them, and the factor that would make them
/// equally large if it is a power of ten.
std::string placement(const Points& data, const Points& model);

}  // namespace tether
