#include "common/io/vtu_writer.hpp"

#include <cstdint>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

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

/// The XML text and the binary block behind it, which the text refers to by offsets.
class VtuText {
 public:
  void line(const std::string& text) { xml_ += text + "\n"; }

  template <class Number>
  void array(const std::string& name, const char* type, int components, const Number* values, std::size_t count) {
    line(fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type,
                     name, components, binary_.size()));
    const std::uint64_t bytes = count * sizeof(Number);
    append(&bytes, sizeof bytes);
    append(values, bytes);
  }
  void array(const Field& field) {
    array(field.name, "Float64", field.components, field.values.data(), field.values.size());
  }

  void save(const std::filesystem::path& path) const {
    std::ofstream file(path, std::ios::binary);
    file << xml_ << "<AppendedData encoding=\"raw\">\n_";
    file.write(binary_.data(), static_cast<std::streamsize>(binary_.size()));
    file << "\n</AppendedData>\n</VTKFile>\n";
    file.close();
    if (!file) throw write_error(path);
  }

 private:
  void append(const void* data, std::size_t bytes) { binary_.append(static_cast<const char*>(data), bytes); }
  std::string xml_, binary_;
};

void write_cells(VtuText& text, const Cells& cells) {
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
  text.array("connectivity", "Int32", 1, nodes.data(), nodes.size());
  text.array("offsets", "Int32", 1, ends.data(), ends.size());
  text.array("types", "UInt8", 1, types.data(), types.size());
  text.line("</Cells>");
}

void write_fields(VtuText& text, const char* section, const std::vector<Field>& fields, std::size_t count) {
  text.line(fmt::format("<{}>", section));
  for (const Field& field : fields) {
    TETHER_ASSERT(field.values.size() == count * static_cast<std::size_t>(field.components),
                  "{}: {} values for {} places", field.name, field.values.size(), count);
    text.array(field);
  }
  text.line(fmt::format("</{}>", section));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Points& points, const Cells& cells,
               const std::vector<Field>& at_nodes, const std::vector<Field>& in_cells) {
  const auto nodes = static_cast<std::size_t>(points.cols());
  VtuText text;
  text.line(R"(<?xml version="1.0"?>)");
  text.line(R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">)");
  text.line(fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>", nodes,
                        cells.count()));
  text.array("points", "Float64", 3, points.data(), 3 * nodes);
  text.line("</Points>");
  write_cells(text, cells);
  write_fields(text, "PointData", at_nodes, nodes);
  write_fields(text, "CellData", in_cells, cells.count());
  text.line("</Piece>\n</UnstructuredGrid>");
  text.save(path);
}

}  // namespace tether
