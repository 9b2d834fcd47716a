#include "common/io/vtp_writer.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/io/vtk_xml.hpp"

namespace tether {

namespace {

/// Cells of one kind: the nodes of each, one after the other, and where each ends.
struct CellList {
  std::string_view kind;  ///< Lines, Polys
  std::vector<int> nodes, ends;
  void end() { ends.push_back(static_cast<int>(nodes.size())); }
};

/// A named array of PointData or CellData; none if it is empty.
template <class Number>
struct Data {
  const char* section;
  const std::string& name;
  const std::vector<Number>& values;
};

template <class Coordinate, class Number>
void write_poly_data(const std::filesystem::path& path, const std::vector<Coordinate>& points, const CellList& cells,
                     const Data<Number>& data) {
  const auto count = [&](std::string_view kind) { return cells.kind == kind ? cells.ends.size() : 0; };
  VtkXml text("PolyData");
  text.line(fmt::format(
      R"(<Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="{}">)",
      points.size() / 3, count("Lines"), count("Polys")));
  text.line("<Points>");
  text.array("points", 3, points);
  text.line("</Points>");
  if (!data.values.empty()) {
    text.line(fmt::format("<{}>", data.section));
    text.array(data.name, 1, data.values);
    text.line(fmt::format("</{}>", data.section));
  }
  text.line(fmt::format("<{}>", cells.kind));
  text.array("connectivity", 1, cells.nodes);
  text.array("offsets", 1, cells.ends);
  text.line(fmt::format("</{}>\n</Piece>", cells.kind));
  text.save(path);
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
  CellList cells{"Lines", {}, {}};
  for (const Points& line : lines) {
    coordinates.insert(coordinates.end(), line.data(), line.data() + line.size());
    for (Eigen::Index i = 0; i < line.cols(); ++i) cells.nodes.push_back(static_cast<int>(cells.nodes.size()));
    cells.end();
  }
  write_poly_data(path, coordinates, cells, Data<double>{"PointData", name, values});
}

void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles,
               const std::vector<int>& labels) {
  const std::vector<float> coordinates(points.data(), points.data() + points.size());
  CellList cells{"Polys", {}, {}};
  for (const Triangle& triangle : triangles) {
    cells.nodes.insert(cells.nodes.end(), triangle.begin(), triangle.end());
    cells.end();
  }
  write_poly_data(path, coordinates, cells, Data<int>{"CellData", "ModelFaceID", labels});
}

}  // namespace tether
