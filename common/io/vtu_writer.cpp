#include "common/io/vtu_writer.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "common/base/error.hpp"
#include "common/io/vtk_xml.hpp"

namespace tether {

Field Field::scalars(std::string name, const VectorXd& one_each) {
  return {std::move(name), 1, {one_each.data(), one_each.data() + one_each.size()}};
}
Field Field::vectors(std::string name, const Points& columns) {
  return {std::move(name), 3, {columns.data(), columns.data() + columns.size()}};
}
Field Field::vectors(std::string name, std::span<const double> node_wise) {
  return {std::move(name), 3, {node_wise.begin(), node_wise.end()}};
}

namespace {

enum VtkCell : std::uint8_t { vtk_triangle = 5, vtk_tetrahedron = 10, vtk_wedge = 13 };

void write_cells(VtkXml& text, const Cells& cells) {
  std::vector<std::int32_t> nodes, ends;
  std::vector<std::uint8_t> types;
  const auto add = [&](const auto& element, VtkCell type) {
    nodes.insert(nodes.end(), element.begin(), element.end());
    ends.push_back(static_cast<std::int32_t>(nodes.size()));
    types.push_back(type);
  };
  for (const Tetrahedron& t : cells.tetrahedra) add(t, vtk_tetrahedron);
  for (const Prism& p : cells.prisms) add(Prism{p[0], p[2], p[1], p[3], p[5], p[4]}, vtk_wedge);
  for (const Triangle& t : cells.triangles) add(t, vtk_triangle);
  text.line("<Cells>");
  text.array("connectivity", 1, nodes);
  text.array("offsets", 1, ends);
  text.array("types", 1, types);
  text.line("</Cells>");
}

void write_fields(VtkXml& text, const char* section, const std::vector<Field>& fields, std::size_t count) {
  text.line(fmt::format("<{}>", section));
  for (const Field& field : fields) {
    TETHER_ASSERT(field.values.size() == count * static_cast<std::size_t>(field.components),
                  "{}: {} values for {} places", field.name, field.values.size(), count);
    text.array(field.name, field.components, field.values);
  }
  text.line(fmt::format("</{}>", section));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Points& points, const Cells& cells,
               const std::vector<Field>& at_nodes, const std::vector<Field>& in_cells) {
  const auto nodes = static_cast<std::size_t>(points.cols());
  VtkXml text("UnstructuredGrid");
  text.line(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>", nodes, cells.count()));
  text.array("points", 3, points.data(), 3 * nodes);
  text.line("</Points>");
  write_cells(text, cells);
  write_fields(text, "PointData", at_nodes, nodes);
  write_fields(text, "CellData", in_cells, cells.count());
  text.line("</Piece>");
  text.save(path);
}

}  // namespace tether
