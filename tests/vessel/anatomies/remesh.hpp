#pragma once

#include "vessel/surface/surface.hpp"

namespace tether {

/// The surface with edges of about this length, borders between labels kept as lines (isotropic remeshing of CGAL).
LabelledSurface remeshed(const LabelledSurface& surface, double edge, int iterations = 5);

}  // namespace tether
