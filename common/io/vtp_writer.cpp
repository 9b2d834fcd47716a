#include "common/io/vtp_writer.hpp"

#include <fmt/ranges.h>

#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {

namespace {

std::string point_data(const std::string& name, const std::vector<double>& values) {
  if (name.empty()) return "";
  return fmt::format("<PointData><DataArray type=\"Float64\" Name=\"{}\" format=\"ascii\">{}</DataArray></PointData>\n",
                     name, fmt::join(values, " "));
}

std::string cell_data(const std::vector<int>& labels) {
  if (labels.empty()) return "";
  return fmt::format(
      "<CellData><DataArray type=\"Int32\" Name=\"ModelFaceID\" format=\"ascii\">{}</DataArray></CellData>\n",
      fmt::join(labels, " "));
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const std::vector<Points>& lines) {
  write_vtp(path, lines, "", {});
}

void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles) {
  write_vtp(path, points, triangles, {});
}

void write_vtp(const std::filesystem::path& path, const std::vector<Points>& lines, const std::string& name,
               const std::vector<double>& values) {
  std::string points, connectivity, offsets;
  Eigen::Index count = 0;
  for (const Points& line : lines) {
    for (const auto& x : line.colwise()) {
      points += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
      connectivity += fmt::format("{} ", count++);
    }
    offsets += fmt::format("{} ", count);
  }
  std::ofstream file(path);
  file << fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="{}" NumberOfLines="{}" NumberOfVerts="0" NumberOfStrips="0" NumberOfPolys="0">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
{}</DataArray></Points>
{}<Lines><DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray></Lines>
</Piece></PolyData></VTKFile>
)",
                      count, lines.size(), points, point_data(name, values), connectivity, offsets);
  file.flush();
  if (!file) throw write_error(path);
}

void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles,
               const std::vector<int>& labels) {
  std::string coordinates, connectivity, offsets;
  for (const auto& x : points.colwise())
    coordinates +=
        fmt::format("{} {} {}\n", static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2]));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    connectivity += fmt::format("{} {} {}\n", triangles[i][0], triangles[i][1], triangles[i][2]);
    offsets += fmt::format("{} ", 3 * (i + 1));
  }
  std::ofstream file(path);
  file << fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="{}" NumberOfPolys="{}" NumberOfVerts="0" NumberOfStrips="0" NumberOfLines="0">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
{}</DataArray></Points>
{}<Polys><DataArray type="Int64" Name="connectivity" format="ascii">
{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray></Polys>
</Piece></PolyData></VTKFile>
)",
                      points.cols(), triangles.size(), coordinates, cell_data(labels), connectivity, offsets);
  file.flush();
  if (!file) throw write_error(path);
}

}  // namespace tether
