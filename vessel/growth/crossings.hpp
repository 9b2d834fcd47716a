#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Triangles of a surface that cut another one of it with which they share no node, ascending.
std::vector<int> crossing_triangles(const Points& points, const std::vector<Triangle>& triangles);

}  // namespace tether
