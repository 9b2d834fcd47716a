#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "common/base/error.hpp"
#include "vessel/cell_sorter.hpp"
#include "vessel/file_source.hpp"
#include "vessel/readers.hpp"

/// Stanford's .ply (paulbourke.net/dataformats/ply), text and binary.
namespace tether {

namespace {

constexpr std::size_t most_names = 1000;  ///< of elements and properties: each is looked for among the others

struct PlyProperty {
  std::string name;
  Scalar type;
  std::optional<Scalar> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& path) : source_(path), sorter_(mesh_) { mesh_.name = path.string(); }

  MeshFile read() {
    read_header();
    for (const PlyElement& element : elements_) read_element(element);
    check_end();
    if (!has_points_) throw input_error("{}: has no element vertex", mesh_.name);
    if (mesh_.triangles.empty()) throw input_error("{}: holds no face", mesh_.name);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    if (source_.line() != "ply") source_.fail("is no PLY file: the first line must be \"ply\"");
    Encoding encoding = Encoding::text;
    bool has_format = false;
    for (;;) {
      const std::string_view word = source_.word();
      if (word == "end_header") break;
      if (word == "format") {
        if (has_format) source_.fail("a second format: must be one");
        encoding = read_format();
        has_format = true;
      } else if (word == "element") {
        count_name();
        elements_.push_back(read_element_line());
      } else if (word == "property") {
        if (elements_.empty()) source_.fail("a property before any element");
        count_name();
        add_property(elements_.back());
      } else if (word != "comment" && word != "obj_info") {
        source_.fail_expected("format, element, property, comment or end_header", word);
      }
      source_.line();
    }
    source_.line();
    if (!has_format) source_.fail("the header states no format");
    if (elements_.empty()) source_.fail("the header states no elements");
    source_.set_encoding(encoding);
  }

  void count_name() {
    if (++names_ > most_names) source_.fail(fmt::format("has more than {} elements and properties", most_names));
  }

  Encoding read_format() {
    static const std::map<std::string, Encoding, std::less<>> known{{"ascii", Encoding::text},
                                                                    {"binary_little_endian", Encoding::little_endian},
                                                                    {"binary_big_endian", Encoding::big_endian}};
    const std::string_view word = header_word();
    const auto found = known.find(word);
    if (found == known.end()) source_.fail_expected("ascii, binary_little_endian or binary_big_endian", word);
    if (const std::string_view version = header_word(); version != "1.0") source_.fail_expected("1.0", version);
    return found->second;
  }

  PlyElement read_element_line() {
    const std::string name(header_word());
    if (std::any_of(elements_.begin(), elements_.end(), [&](const PlyElement& other) { return other.name == name; }))
      source_.fail(fmt::format("a second element {}: must be one", name));
    if (source_.at_end_of_line()) source_.fail(fmt::format("the number of {} is missing", name));
    return {name, source_.count(name), {}};
  }

  void add_property(PlyElement& element) {
    PlyProperty its = read_property();
    for (const PlyProperty& other : element.properties)
      if (other.name == its.name) source_.fail(fmt::format("{} has two properties {}", element.name, its.name));
    element.properties.push_back(std::move(its));
  }

  PlyProperty read_property() {
    std::string_view word = header_word();
    std::optional<Scalar> count_type;
    if (word == "list") {
      count_type = type_of(header_word());
      if (!is_integer(*count_type)) source_.fail("the length of a list must be an integer");
      word = header_word();
    }
    const Scalar type = type_of(word);
    return {std::string(header_word()), type, count_type};
  }

  Scalar type_of(std::string_view word) const {
    static const std::map<std::string, Scalar, std::less<>> known{
        {"char", Scalar::int8},      {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
        {"uint8", Scalar::uint8},    {"short", Scalar::int16},     {"int16", Scalar::int16},
        {"ushort", Scalar::uint16},  {"uint16", Scalar::uint16},   {"int", Scalar::int32},
        {"int32", Scalar::int32},    {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
        {"float", Scalar::float32},  {"float32", Scalar::float32}, {"double", Scalar::float64},
        {"float64", Scalar::float64}};
    const auto found = known.find(word);
    if (found == known.end()) source_.fail_expected("a type of numbers (uchar, int, float ...)", word);
    return found->second;
  }

  /// Blank lines and comments may stand behind the last element.
  void check_end() {
    while (!source_.at_end()) {
      const std::size_t left = source_.left();
      if (const std::string_view word = source_.word(); source_.text() && (word == "comment" || word.starts_with('#')))
        source_.line();
      else
        source_.fail(fmt::format("{} {} are stated, {} bytes stand behind the last: must be as many as there are",
                                 elements_.back().count, elements_.back().name, left));
    }
  }

  /// Of this line, so that a line cut short does not take the next one's.
  std::string_view header_word() { return source_.at_end_of_line() ? std::string_view() : source_.word(); }

  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;
    require_room(element);
    if (element.name == "vertex") return read_points(element);
    if (element.name == "face") return read_faces(element);
    for (std::uint64_t i = 0; i < element.count; ++i) read_item(element, i, [](std::size_t, double) {});
  }

  /// Whether the file can hold the element, with empty lists.
  void require_room(const PlyElement& element) const {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties)
      bytes += source_.text() ? 2 : size_of(property.count_type.value_or(property.type));
    if (source_.text() && element.count > 0)
      source_.require(element.count - 1, bytes, element.name);  // the last one may lack its end of line
    else
      source_.require(element.count, bytes, element.name);
  }

  void read_points(const PlyElement& element) {
    if (element.count > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
      source_.fail(fmt::format("{} points are more than can be read", element.count));
    const std::array<std::size_t, 3> columns{column(element, "x"), column(element, "y"), column(element, "z")};
    mesh_.points.resize(3, static_cast<Eigen::Index>(element.count));
    for (Eigen::Index point = 0; point < mesh_.points.cols(); ++point)
      read_item(element, static_cast<std::uint64_t>(point), [&](std::size_t property, double value) {
        for (int i = 0; i < 3; ++i)
          if (columns[static_cast<std::size_t>(i)] == property) mesh_.points(i, point) = coordinate(value);
      });
    has_points_ = true;
  }

  std::size_t column(const PlyElement& element, std::string_view name) const {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (element.properties[i].name == name && !element.properties[i].count_type) return i;
    throw input_error("{}: the vertices have no property {} of one number", mesh_.name, name);
  }

  double coordinate(double value) const {
    if (!std::isfinite(value)) source_.fail(fmt::format("the coordinate {} is not a finite number", value));
    return value;
  }

  void read_faces(const PlyElement& element) {
    if (!has_points_) source_.fail("faces stand before the vertices that they name");
    const std::size_t nodes = node_list(element);
    for (std::uint64_t face = 0; face < element.count; ++face) {
      nodes_.clear();
      read_item(element, face, [&](std::size_t property, double value) {
        if (property == nodes) nodes_.push_back(static_cast<std::int64_t>(value));
      });
      if (nodes_.size() < 3) source_.fail(fmt::format("face {} (from 0) has {} nodes", face, nodes_.size()));
      if (const std::string wrong = wrong_node(face, nodes_, mesh_.points.cols()); !wrong.empty()) source_.fail(wrong);
      sorter_.add(vtk_polygon, nodes_);
    }
  }

  std::size_t node_list(const PlyElement& element) const {
    const auto& properties = element.properties;
    const auto found = std::find_if(properties.begin(), properties.end(), [](const PlyProperty& p) {
      return p.count_type && is_integer(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index");
    });
    if (found == properties.end())
      throw input_error("{}: the faces have no list of integers vertex_indices or vertex_index", mesh_.name);
    return static_cast<std::size_t>(found - properties.begin());
  }

  /// Calls take(property, value) with each number of one vertex, one face ...; in text it is a line.
  template <class Take>
  void read_item(const PlyElement& element, std::uint64_t item, const Take& take) {
    if (source_.text()) source_.at_end();  // empty lines
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      std::uint64_t values = 1;
      if (property.count_type) values = list_length(element, item, property);
      for (; values > 0; --values) take(i, value(element, item, property, property.type));
    }
    if (source_.text() && !source_.at_end_of_line())
      source_.fail(fmt::format("more numbers than {} {} (from 0) has", element.name, item));
  }

  std::uint64_t list_length(const PlyElement& element, std::uint64_t item, const PlyProperty& property) {
    const double length = value(element, item, property, *property.count_type);
    if (length < 0)
      source_.fail(
          fmt::format("the list {} of {} {} (from 0) has {} values", property.name, element.name, item, length));
    const auto values = static_cast<std::uint64_t>(length);
    source_.require_numbers(values, property.type, property.name);
    return values;
  }

  double value(const PlyElement& element, std::uint64_t item, const PlyProperty& property, Scalar type) {
    if (source_.text() && source_.at_end_of_line())
      source_.fail(fmt::format("{} {} (from 0) ends before its {}: fewer numbers than stated, or cut short",
                               element.name, item, property.name));
    return is_integer(type) ? static_cast<double>(source_.integer(type)) : source_.real(type);
  }

  FileSource source_;
  MeshFile mesh_;
  CellSorter sorter_;
  std::vector<PlyElement> elements_;
  std::size_t names_ = 0;            // of elements and properties, so far
  std::vector<std::int64_t> nodes_;  // of a face
  bool has_points_ = false;
};

}  // namespace

MeshFile read_ply(const std::filesystem::path& path) {
  return PlyReader(path).read();
}

}  // namespace tether
