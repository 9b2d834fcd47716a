#pragma once

#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/surface_check.hpp"

/// The ends of a model's lumen are open: blood passes there. A segmentation often is closed there by flat ends, which
/// are no wall.
namespace tether {

/// An end of the model's lumen.
struct Opening {
  Vec3 centre, axis;  ///< unit, out of the vessel
  double radius = 0;  ///< of a circle as long as its rim [length]
};

std::vector<Opening> openings_of(const LumenSurface& lumen);

/// Leaves out the flat ends of a measured surface, and notes it: what is connected with the place where the axis of an
/// opening meets the surface, as long as it looks along that axis (within 45 degrees) and lies within one radius of the
/// opening's plane and one and a half of its axis. The surface then is open there, like the model. A surface that
/// closes otherwise near an open end of the model is noted.
void open_ends(CheckedSurface& checked, const std::vector<Opening>& openings);

/// Its open ends closed by fans.
TriangleSurface closed_by_fans(const LumenSurface& lumen);

/// 2 V / A of a surface with its holes closed by fans, A without them: the radius of a tube [length].
double mean_radius(const TriangleSurface& surface);

}  // namespace tether
