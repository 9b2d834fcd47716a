#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// Holds what a .vtp or .vtu file states (numbers of points, cells and components, sizes of blocks, offsets of cells)
/// against what it has, since VTK trusts it and takes memory for it. `kind`: PolyData or UnstructuredGrid. Throws
/// InputError with the line and the attribute.
void check_xml_vtk(const std::filesystem::path& path, const std::string& kind);

}  // namespace tether
