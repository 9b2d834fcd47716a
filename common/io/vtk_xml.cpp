#include "common/io/vtk_xml.hpp"

#include <fmt/format.h>

#include <fstream>

#include "common/base/write_error.hpp"

namespace tether {

VtkXml::VtkXml(std::string_view type) : type_(type) {
  line(R"(<?xml version="1.0"?>)");
  line(fmt::format(R"(<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64">)", type));
  line(fmt::format("<{}>", type));
}

void VtkXml::line(std::string_view text) {
  xml_.append(text).append("\n");
}

void VtkXml::add(std::string_view type, std::string_view name, int components, const void* values, std::size_t bytes) {
  line(fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type,
                   name, components, binary_.size()));
  const std::uint64_t header = bytes;
  binary_.append(reinterpret_cast<const char*>(&header), sizeof header);
  binary_.append(static_cast<const char*>(values), bytes);
}

void VtkXml::save(const std::filesystem::path& path) const {
  std::ofstream file(path, std::ios::binary);
  file << xml_ << fmt::format("</{}>\n<AppendedData encoding=\"raw\">\n_", type_);
  file.write(binary_.data(), static_cast<std::streamsize>(binary_.size()));
  file << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
  if (!file) throw write_error(path);
}

}  // namespace tether
