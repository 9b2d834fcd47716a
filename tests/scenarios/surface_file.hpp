#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A surface as an STL file in text.
inline void write_stl(const std::filesystem::path& path, const Points& x, const std::vector<Triangle>& triangles) {
  std::ofstream file(path);
  file << "solid lumen\n";
  for (const Triangle& t : triangles) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const int node : t) file << fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", x(0, node), x(1, node), x(2, node));
    file << "endloop\nendfacet\n";
  }
  file << "endsolid lumen\n";
}

}  // namespace tether
