#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/lower_case.hpp"
#include "vessel/cell_sorter.hpp"
#include "vessel/file_source.hpp"
#include "vessel/readers.hpp"

/// VTK's legacy .vtk, versions 1 to 5.1, of surfaces and unstructured grids (VTK User's Guide, "VTK File Formats").
namespace tether {

namespace {

/// None: no type of numbers. A bit is read apart.
std::optional<Scalar> legacy_type(const std::string& word) {
  static const std::map<std::string, Scalar> known{{"bit", Scalar::uint8},          {"char", Scalar::int8},
                                                   {"signed_char", Scalar::int8},   {"unsigned_char", Scalar::uint8},
                                                   {"short", Scalar::int16},        {"unsigned_short", Scalar::uint16},
                                                   {"int", Scalar::int32},          {"unsigned_int", Scalar::uint32},
                                                   {"long", Scalar::int64},         {"unsigned_long", Scalar::uint64},
                                                   {"vtktypeint64", Scalar::int64}, {"vtktypeuint64", Scalar::uint64},
                                                   {"vtkidtype", Scalar::int32},  // VTK writes it so
                                                   {"float", Scalar::float32},      {"double", Scalar::float64}};
  const auto found = known.find(word);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// VTK writes a blank in a name as %20.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const std::string hex(name.substr(i + 1 < name.size() ? i + 1 : name.size(), 2));
    if (name[i] == '%' && hex.size() == 2 && hex.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos) {
      text += static_cast<char>(std::strtol(hex.c_str(), nullptr, 16));
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

/// One list of cells; cell i has the nodes up to ends[i].
struct CellList {
  std::vector<std::int64_t> nodes;
  std::vector<std::size_t> ends;

  std::span<const std::int64_t> cell(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(nodes).subspan(begin, ends[i] - begin);
  }
};

class LegacyVtkReader {
 public:
  explicit LegacyVtkReader(const std::filesystem::path& path) : source_(path) { mesh_.name = path.string(); }

  MeshFile read() {
    read_header();
    while (!source_.at_end()) read_section(keyword());
    if (mesh_.points.cols() == 0) throw input_error("{}: has no points", mesh_.name);
    CellSorter sorter(mesh_);
    dataset_ == Dataset::grid ? add_grid_cells(sorter) : add_surface_cells(sorter);
    for (const auto& [name, values] : cell_arrays_) add_labels(mesh_, name, values, sorter);
    if (node_ids_) add_node_ids(mesh_, *node_ids_);
    return std::move(mesh_);
  }

 private:
  enum class Dataset { none, surface, grid };
  enum class Where { dataset, cells, points };

  void read_header() {
    const std::string first(source_.line()), start = "# vtk DataFile Version ";
    if (!first.starts_with(start)) source_.fail("is no VTK file: the first line must be \"" + start + "...\"");
    version_ = std::strtod(first.c_str() + start.size(), nullptr);
    if (!(version_ >= 1 && version_ < 5.2))
      source_.fail(fmt::format("version {}: must be 1 to 5.1", first.substr(start.size(), 20)));
    source_.line();  // the title
    const std::string_view encoding = source_.word();
    if (lower_case(std::string(encoding)) == "binary") {
      source_.set_encoding(Encoding::big_endian);
    } else if (lower_case(std::string(encoding)) != "ascii") {
      source_.fail_expected("ASCII or BINARY", encoding);
    }
  }

  std::string keyword() { return lower_case(std::string(source_.word())); }
  std::string name() {
    const std::string_view word = source_.word();
    if (word.empty()) source_.fail_expected("a name", word);
    return decoded(word);
  }
  void expect(const std::string& expected) {
    const std::string_view found = source_.word();
    if (lower_case(std::string(found)) != lower_case(expected)) source_.fail_expected(expected, found);
  }
  std::string type_word() {
    const std::string_view word = source_.word();
    const std::string type = lower_case(std::string(word));
    if (!legacy_type(type)) source_.fail_expected("a type of numbers (int, float, double ...)", word);
    return type;
  }
  Scalar number_type() { return *legacy_type(type_word()); }

  /// Binary data begin behind the line that announces them; text may go on in it.
  void begin_data() {
    if (source_.text()) return;
    if (!source_.at_end_of_line()) source_.fail_expected("the end of the line", source_.word());
    source_.line();
  }

  void read_section(const std::string& section) {
    static const std::map<std::string, std::function<void(LegacyVtkReader&)>> sections{
        {"dataset", [](auto& r) { r.read_dataset(); }},
        {"metadata", [](auto& r) { r.skip_metadata(); }},
        {"field", [](auto& r) { r.read_field(); }},
        {"points", [](auto& r) { r.read_points(); }},
        {"vertices", [](auto& r) { r.read_surface_cells(r.lists_[0], 1); }},
        {"lines", [](auto& r) { r.read_surface_cells(r.lists_[1], 1); }},
        {"polygons", [](auto& r) { r.read_surface_cells(r.lists_[2], 3); }},
        {"triangle_strips", [](auto& r) { r.read_surface_cells(r.lists_[3], 3); }},
        {"cells", [](auto& r) { r.read_grid_cells(); }},
        {"cell_types", [](auto& r) { r.read_cell_types(); }},
        {"cell_data", [](auto& r) { r.begin_arrays(Where::cells, "cells", r.number_of_cells()); }},
        {"point_data",
         [](auto& r) { r.begin_arrays(Where::points, "points", static_cast<std::size_t>(r.mesh_.points.cols())); }},
        {"scalars", [](auto& r) { r.read_scalars(); }},
        {"color_scalars", [](auto& r) { r.read_colors(); }},
        {"lookup_table", [](auto& r) { r.skip_lookup_table(); }},
        {"vectors", [](auto& r) { r.read_attribute(3); }},
        {"normals", [](auto& r) { r.read_attribute(3); }},
        {"tensors", [](auto& r) { r.read_attribute(9); }},
        {"tensors6", [](auto& r) { r.read_attribute(6); }},
        {"texture_coordinates", [](auto& r) { r.read_texture_coordinates(); }},
        {"global_ids", [](auto& r) { r.read_attribute(1); }},
        {"pedigree_ids", [](auto& r) { r.read_attribute(1); }},
        {"edge_flags", [](auto& r) { r.read_attribute(1); }}};
    const auto found = sections.find(section);
    if (found == sections.end()) source_.fail_expected("a section (POINTS, CELLS, POLYGONS, CELL_DATA ...)", section);
    check_is_first(section);
    found->second(*this);
  }

  /// Another one would take the place of what cells and arrays behind the first were held against.
  void check_is_first(const std::string& section) {
    static const std::set<std::string> single{"dataset",  "points",          "vertices", "lines",
                                              "polygons", "triangle_strips", "cells",    "cell_types"};
    if (single.contains(section) && !seen_.insert(section).second)
      source_.fail(fmt::format("a second section {}: must be one", section));
  }

  void read_dataset() {
    const std::string kind = keyword();
    if (kind != "polydata" && kind != "unstructured_grid")
      source_.fail("is not a VTK file with an unstructured grid or a surface, but " + kind.substr(0, 40));
    dataset_ = kind == "polydata" ? Dataset::surface : Dataset::grid;
  }

  /// Goes behind the empty line that ends it.
  void skip_metadata() {
    source_.line();
    while (source_.left() > 0 && !source_.line().empty()) continue;
  }

  void read_points() {
    const std::uint64_t points = source_.count("points");
    const Scalar type = number_type();
    source_.require(points, 3, "points");
    source_.require_numbers(3 * points, type, "coordinates");
    if (points > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) source_.fail("more points than 2^31");
    begin_data();
    mesh_.points.resize(3, static_cast<Eigen::Index>(points));
    for (double& x : mesh_.points.reshaped())
      if (x = source_.real(type); !std::isfinite(x))
        source_.fail(fmt::format("the coordinate {} is not a finite number", x));
  }

  void read_surface_cells(CellList& list, std::size_t least_nodes) {
    if (dataset_ != Dataset::surface) source_.fail("cells of a surface stand where there is no DATASET POLYDATA");
    read_cells(list, least_nodes);
  }
  void read_grid_cells() {
    if (dataset_ != Dataset::grid) source_.fail("CELLS stand where there is no DATASET UNSTRUCTURED_GRID");
    read_cells(lists_[0], 1);
  }
  void read_cells(CellList& list, std::size_t least_nodes) {
    if (mesh_.points.cols() == 0) source_.fail("cells stand before the points that they name");
    version_ < 5 ? read_counted_cells(list, least_nodes) : read_cells_with_offsets(list, least_nodes);
  }

  /// Up to version 4: of each cell the number of its nodes, then the nodes.
  void read_counted_cells(CellList& list, std::size_t least_nodes) {
    const std::uint64_t cells = source_.count("cells"), size = source_.count("integers of the cells");
    source_.require_numbers(cells, Scalar::int32, "cells");
    source_.require_numbers(size, Scalar::int32, "integers of the cells");
    begin_data();
    std::uint64_t left = size;
    for (std::uint64_t cell = 0; cell < cells; ++cell) {
      const std::int64_t nodes = source_.integer(Scalar::int32);
      if (nodes < static_cast<std::int64_t>(least_nodes) || static_cast<std::uint64_t>(nodes) >= left)
        source_.fail(fmt::format("cell {} (from 0) has {} nodes, where {} of the {} integers stated are left", cell,
                                 nodes, left, size));
      left -= static_cast<std::uint64_t>(nodes) + 1;
      read_cell(list, static_cast<std::size_t>(nodes), Scalar::int32);
    }
    if (left > 0) source_.fail(fmt::format("the cells have {} integers, {} are stated", size - left, size));
  }

  /// From version 5 on: where in the list of all nodes each cell begins, then this list.
  void read_cells_with_offsets(CellList& list, std::size_t least_nodes) {
    const std::uint64_t offsets = source_.count("offsets"), nodes = source_.count("nodes of the cells");
    if (offsets == 0 && nodes == 0) return;
    expect("OFFSETS");
    const Scalar offset_type = integer_type();
    source_.require_numbers(offsets, offset_type, "offsets");
    begin_data();
    std::vector<std::size_t> sizes;
    std::int64_t before = 0;
    for (std::uint64_t i = 0; i < offsets; ++i) {
      const std::int64_t offset = source_.integer(offset_type);
      const std::int64_t least = i == 0 ? 0 : before + static_cast<std::int64_t>(least_nodes);
      if (offset < least || static_cast<std::uint64_t>(offset) > nodes || (i == 0 && offset > 0))
        source_.fail(fmt::format("offset {} (from 0) is {}, behind {}, of {} nodes", i, offset, before, nodes));
      if (i > 0) sizes.push_back(static_cast<std::size_t>(offset - before));
      before = offset;
    }
    if (static_cast<std::uint64_t>(before) != nodes)
      source_.fail(fmt::format("the last offset is {}: {} nodes are stated", before, nodes));
    expect("CONNECTIVITY");
    const Scalar type = integer_type();
    source_.require_numbers(nodes, type, "nodes of the cells");
    begin_data();
    for (const std::size_t size : sizes) read_cell(list, size, type);
  }

  Scalar integer_type() {
    const Scalar type = number_type();
    if (!is_integer(type)) source_.fail("a type of integers was expected");
    return type;
  }

  void read_cell(CellList& list, std::size_t nodes, Scalar type) {
    for (std::size_t i = 0; i < nodes; ++i) list.nodes.push_back(source_.integer(type));
    list.ends.push_back(list.nodes.size());
    const std::size_t cell = list.ends.size() - 1;
    if (const std::string wrong = wrong_node(cell, list.cell(cell), mesh_.points.cols()); !wrong.empty())
      source_.fail(wrong);
  }

  void read_cell_types() {
    const std::uint64_t cells = source_.count("cell types");
    if (cells != lists_[0].ends.size())
      source_.fail(fmt::format("{} types of cells, the file has {} cells before them", cells, lists_[0].ends.size()));
    source_.require_numbers(cells, Scalar::int32, "cell types");
    begin_data();
    for (std::uint64_t i = 0; i < cells; ++i) types_.push_back(source_.integer(Scalar::int32));
  }

  std::size_t number_of_cells() const {
    std::size_t cells = 0;
    for (const CellList& list : lists_) cells += list.ends.size();
    return cells;
  }

  void begin_arrays(Where where, const std::string& of_what, std::size_t expected) {
    where_ = where;
    values_ = source_.count(of_what);
    if (values_ != expected)
      source_.fail(fmt::format("data of {} {}, the file has {} before them", values_, of_what, expected));
  }

  void read_scalars() {
    const std::string array = name(), type = type_word();
    const std::uint64_t components = source_.at_end_of_line() ? 1 : source_.count("components");
    expect("LOOKUP_TABLE");
    name();
    read_array(array, type, components, attribute_values());
  }
  void read_attribute(std::uint64_t components) {
    const std::string array = name();
    read_array(array, array_type(), components, attribute_values());
  }
  void read_texture_coordinates() {
    const std::string array = name();
    const std::uint64_t components = source_.count("components");
    read_array(array, type_word(), components, attribute_values());
  }
  /// Bytes in binary files, in text numbers from 0 to 1.
  void read_colors() {
    const std::string array = name();
    const std::uint64_t components = source_.count("components");
    if (!source_.text()) return read_array(array, "unsigned_char", components, attribute_values());
    std::vector<double> values = read_numbers(array, "float", components, attribute_values());
    for (double& value : values) value = std::trunc(255 * value + 0.5);
    if (components == 1) take(array, std::move(values));
  }
  void skip_lookup_table() {
    const std::string array = name();
    const std::uint64_t colors = source_.count("colours");
    read_numbers(array, source_.text() ? "float" : "unsigned_char", 4, colors);
  }
  std::uint64_t attribute_values() const {
    if (where_ == Where::dataset) source_.fail("an array stands before CELL_DATA or POINT_DATA");
    return values_;
  }

  void read_field() {
    name();
    for (std::uint64_t arrays = source_.count("arrays"); arrays > 0; --arrays) {
      std::string array = name();
      while (array == "METADATA") skip_metadata(), array = name();
      if (array == "NULL_ARRAY") continue;
      const std::uint64_t components = source_.count("components"), tuples = source_.count("tuples");
      read_array(array, array_type(), components, tuples);
    }
  }

  /// Strings too.
  std::string array_type() {
    const std::string_view word = source_.word();
    const std::string type = lower_case(std::string(word));
    if (!legacy_type(type) && !is_string(type)) source_.fail_expected("a type of an array that can be read", word);
    return type;
  }
  static bool is_string(const std::string& type) { return type == "string" || type == "utf8_string"; }

  void read_array(const std::string& array, const std::string& type, std::uint64_t components, std::uint64_t tuples) {
    if (is_string(type)) return skip_strings(array, components, tuples);
    std::vector<double> values = read_numbers(array, type, components, tuples);
    if (components == 1) take(array, std::move(values));
  }

  std::vector<double> read_numbers(const std::string& array, const std::string& type, std::uint64_t components,
                                   std::uint64_t tuples) {
    const std::uint64_t count = array_size(array, components, tuples);
    const Scalar scalar = *legacy_type(type);
    if (type == "bit" && !source_.text()) return read_bits(array, count);
    source_.require_numbers(count, scalar, "values of array " + array);
    begin_data();
    std::vector<double> values(count);
    for (double& value : values) value = source_.real(scalar);
    return values;
  }

  /// At most eight times as many as there are bytes: so their product is a number too.
  std::uint64_t array_size(const std::string& array, std::uint64_t components, std::uint64_t tuples) const {
    if (components > 0 && tuples > 8 * source_.left() / components)
      source_.fail(fmt::format("array {} of {} tuples of {}: {} bytes are left in the file: cut short?", array, tuples,
                               components, source_.left()));
    return components * tuples;
  }

  /// Eight of them in a byte, the first one the highest.
  std::vector<double> read_bits(const std::string& array, std::uint64_t count) {
    source_.require((count + 7) / 8, 1, "bytes of array " + array);
    begin_data();
    std::vector<double> values(count);
    std::int64_t byte = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 8 == 0) byte = source_.integer(Scalar::uint8);
      values[i] = byte >> (7 - i % 8) & 1;
    }
    return values;
  }

  void skip_strings(const std::string& array, std::uint64_t components, std::uint64_t tuples) {
    const std::uint64_t strings = array_size(array, components, tuples);
    source_.require(strings, 1, "strings of array " + array);
    source_.line();
    for (std::uint64_t i = 0; i < strings; ++i) source_.text() ? void(source_.line()) : skip_binary_string();
  }
  /// Before it stands its length, in as many bytes as the two highest bits say: 3: 1, 2: 2, 1: 4, 0: 8.
  void skip_binary_string() {
    const auto first = static_cast<std::uint64_t>(source_.integer(Scalar::uint8));
    std::uint64_t length = first & 0x3f;
    const std::uint64_t bytes = std::uint64_t{8} >> (first >> 6);
    for (std::uint64_t i = 1; i < bytes; ++i)
      length = length << 8 | static_cast<std::uint64_t>(source_.integer(Scalar::uint8));
    source_.skip(length);
  }

  void take(const std::string& array, std::vector<double> values) {
    if (where_ == Where::cells)
      cell_arrays_.emplace_back(array, std::move(values));
    else if (where_ == Where::points && array == "GlobalNodeID")
      node_ids_ = std::move(values);
  }

  /// In VTK's order, whatever the file's: arrays of the cells have it.
  void add_surface_cells(CellSorter& sorter) const {
    constexpr std::array<int, 4> types{vtk_poly_vertex, vtk_poly_line, vtk_polygon, vtk_triangle_strip};
    for (std::size_t kind = 0; kind < 4; ++kind)
      for (std::size_t i = 0; i < lists_[kind].ends.size(); ++i) sorter.add(types[kind], lists_[kind].cell(i));
  }
  void add_grid_cells(CellSorter& sorter) const {
    const CellList& cells = lists_[0];
    if (types_.size() != cells.ends.size())
      throw input_error("{}: {} cells have {} types: cut short?", mesh_.name, cells.ends.size(), types_.size());
    for (std::size_t i = 0; i < types_.size(); ++i) sorter.add(static_cast<int>(types_[i]), cells.cell(i));
  }

  FileSource source_;
  MeshFile mesh_;
  double version_ = 0;
  Dataset dataset_ = Dataset::none;
  std::set<std::string> seen_;     ///< sections
  std::array<CellList, 4> lists_;  ///< of a surface: vertices, lines, polygons, strips; of a grid: all cells first
  std::vector<std::int64_t> types_;
  Where where_ = Where::dataset;  ///< what the arrays belong to
  std::uint64_t values_ = 0;      ///< of each of them
  std::vector<std::pair<std::string, std::vector<double>>> cell_arrays_;
  std::optional<std::vector<double>> node_ids_;
};

}  // namespace

MeshFile read_legacy_vtk(const std::filesystem::path& path) {
  return LegacyVtkReader(path).read();
}

}  // namespace tether
