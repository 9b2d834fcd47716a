#pragma once

#include <filesystem>
#include <string>

#include "vessel/mesh_file.hpp"

/// One reader a format; read_mesh_file chooses among them. A file that is damaged ends in an InputError, whatever it
/// states.
namespace tether {

MeshFile read_xml_vtk(const std::filesystem::path& path);
MeshFile read_legacy_vtk(const std::filesystem::path& path);
MeshFile read_ply(const std::filesystem::path& path);
MeshFile read_gmsh(const std::filesystem::path& path);
MeshFile read_stl(const std::filesystem::path& path);
MeshFile read_obj(const std::filesystem::path& path);

/// The whole file. Throws InputError if it cannot be opened.
std::string file_content(const std::filesystem::path& path);

}  // namespace tether
