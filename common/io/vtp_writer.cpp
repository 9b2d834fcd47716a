#include "common/io/vtp_writer.hpp"

#include <fmt/format.h>

#include "common/io/vtk_xml.hpp"

namespace tether {

namespace {

/// Cells of so many nodes as `ends` says, the nodes one after the other.
void add_cells(VtkXml& text, const char* section, const std::vector<int>& nodes, const std::vector<int>& ends) {
  text.line(fmt::format("<{}>", section));
  text.array("connectivity", 1, nodes);
  text.array("offsets", 1, ends);
  text.line(fmt::format("</{}>", section));
}

template <class Number>
void add_points(VtkXml& text, const std::vector<Number>& coordinates) {
  text.line("<Points>");
  text.array("points", 3, coordinates);
  text.line("</Points>");
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
  std::vector<double> coordinates;
  std::vector<int> nodes, ends;
  for (const Points& line : lines) {
    coordinates.insert(coordinates.end(), line.data(), line.data() + line.size());
    for (Eigen::Index i = 0; i < line.cols(); ++i) nodes.push_back(static_cast<int>(nodes.size()));
    ends.push_back(static_cast<int>(nodes.size()));
  }
  VtkXml text("PolyData");
  text.line(fmt::format(
      R"(<Piece NumberOfPoints="{}" NumberOfLines="{}" NumberOfVerts="0" NumberOfStrips="0" NumberOfPolys="0">)",
      nodes.size(), lines.size()));
  add_points(text, coordinates);
  if (!name.empty()) {
    text.line("<PointData>");
    text.array(name, 1, values);
    text.line("</PointData>");
  }
  add_cells(text, "Lines", nodes, ends);
  text.line("</Piece>");
  text.save(path);
}

void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles,
               const std::vector<int>& labels) {
  std::vector<float> coordinates(points.data(), points.data() + points.size());
  std::vector<int> nodes, ends;
  for (const Triangle& triangle : triangles) {
    nodes.insert(nodes.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<int>(nodes.size()));
  }
  VtkXml text("PolyData");
  text.line(fmt::format(
      R"(<Piece NumberOfPoints="{}" NumberOfPolys="{}" NumberOfVerts="0" NumberOfStrips="0" NumberOfLines="0">)",
      points.cols(), triangles.size()));
  add_points(text, coordinates);
  if (!labels.empty()) {
    text.line("<CellData>");
    text.array("ModelFaceID", 1, labels);
    text.line("</CellData>");
  }
  add_cells(text, "Polys", nodes, ends);
  text.line("</Piece>");
  text.save(path);
}

}  // namespace tether
