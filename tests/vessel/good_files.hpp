#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/mesh_file.hpp"

/// Small good files of each format that is text, and what is said of them when they are damaged.
namespace tether {
namespace damaged_files_test {

inline const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0.5\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
inline const std::string surface_vtk =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0\n1 0 0.5\n0 1 0\n1 1 0\n"
    "POLYGONS 2 8\n3 0 1 2\n3 1 3 2\nCELL_DATA 2\nSCALARS part int 1\nLOOKUP_TABLE default\n7\n8\nFIELD more 1\n"
    "face 1 2 int\n1 2\nPOINT_DATA 4\nVECTORS v float\n0 0 0 1 1 1 2 2 2 3 3 3\n";
inline const std::string grid_vtk =
    "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "METADATA\nINFORMATION 0\n\nCELLS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3\n0 2 1\n"
    "CELL_TYPES 2\n10\n5\nPOINT_DATA 4\nGLOBAL_IDS GlobalNodeID vtkIdType\n1 2 3 4\n";
inline const std::string vtp =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">\n<CellData>\n"
    "<DataArray type=\"Int32\" Name=\"part\" format=\"ascii\">\n7 8\n</DataArray>\n</CellData>\n<Points>\n"
    "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0\n1 0 0.5\n0 1 0\n1 1 "
    "0\n</DataArray>\n"
    "</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n0 1 2\n1 3 "
    "2\n</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n3 6\n</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n"
    "</VTKFile>\n";
inline const std::string vtu =
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" "
    "NumberOfCells=\"2\">\n<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\n</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" "
    "format=\"ascii\">\n0 1 2 3 0 2 1\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n4 "
    "7\n"
    "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n10 5\n</DataArray>\n</Cells>\n</Piece>\n"
    "</UnstructuredGrid>\n</VTKFile>\n";

/// What becomes of a good file, and what is said of it.
struct Damage {
  std::string is, becomes, message;
};

inline void expect_messages(const std::string& name, const std::string& good, const std::vector<Damage>& damages) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of([&] { read_mesh_file(folder.file(name, good)); }), "accepted");
  for (const Damage& damage : damages) {
    SCOPED_TRACE(damage.is + " -> " + damage.becomes);
    const std::size_t place = good.find(damage.is);
    ASSERT_NE(place, std::string::npos);
    std::string bad = good;
    // "...": the file ends here
    bad.replace(place, damage.becomes == "..." ? std::string::npos : damage.is.size(),
                damage.becomes == "..." ? "" : damage.becomes);
    folder.file(name, bad);
    try {
      read_mesh_file(folder / name);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_TRUE(said.starts_with((folder / name).string() + ":")) << said;
      EXPECT_NE(said.find(damage.message), std::string::npos) << said << "\nhas not: " << damage.message;
    }
  }
}

}  // namespace damaged_files_test
}  // namespace tether
