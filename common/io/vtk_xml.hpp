#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tether {

/// A file of VTK's XML formats: its text, and behind it one block of raw numbers that the text refers to by offsets.
/// Written without VTK, as fast as the disk.
class VtkXml {
 public:
  /// type: PolyData, UnstructuredGrid ...
  explicit VtkXml(std::string_view type);

  void line(std::string_view text);

  /// Numbers of an array, one tuple after the other; those of int become Int32.
  template <class Number>
  void array(std::string_view name, int components, const std::vector<Number>& values) {
    array(name, components, values.data(), values.size());
  }
  template <class Number>
  void array(std::string_view name, int components, const Number* values, std::size_t count) {
    add(type_name<Number>(), name, components, values, count * sizeof(Number));
  }

  /// Ends what the type's name began, and writes. Throws RunError if the file cannot be written.
  void save(const std::filesystem::path& path) const;

 private:
  template <class Number>
  static constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<Number, double>) return "Float64";
    if constexpr (std::is_same_v<Number, float>) return "Float32";
    if constexpr (std::is_same_v<Number, int>) return "Int32";
    if constexpr (std::is_same_v<Number, std::uint8_t>) return "UInt8";
  }
  void add(std::string_view type, std::string_view name, int components, const void* values, std::size_t bytes);

  std::string type_, xml_, binary_;
};

}  // namespace tether
