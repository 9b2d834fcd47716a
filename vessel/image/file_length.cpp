#include "vessel/image/file_length.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <vector>

#include "common/base/error.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

void require(const fs::path& file, std::uint64_t wanted, std::uint64_t there) {
  if (there < wanted)
    throw input_error("{}: its voxels take {} bytes, it has {}: cut short?", file.string(), wanted, there);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "Name = value" up to the line that says where the voxels are.
void check_meta(const fs::path& file, std::uint64_t bytes) {
  std::ifstream in(file, std::ios::binary);
  std::map<std::string, std::string> header;
  for (std::string line; !header.contains("ElementDataFile") && std::getline(in, line);)
    if (const auto equals = line.find('='); equals != std::string::npos)
      header[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  const std::string data = header["ElementDataFile"];
  const bool local = data == "LOCAL", text = header["BinaryData"] == "False" || header["BinaryData"] == "false";
  if (data.empty() || text || data == "LIST" || data.find('%') != std::string::npos) return;
  const fs::path voxels = local ? file : file.parent_path() / data;
  if (!fs::exists(voxels)) throw input_error("{}: names the file {}, which is not there", file.string(), data);
  const std::uint64_t there = fs::file_size(voxels) - (local ? static_cast<std::uint64_t>(in.tellg()) : 0);
  if (header["CompressedData"] != "True" && header["CompressedData"] != "true")
    require(voxels, bytes, there);
  else if (const std::string size = header["CompressedDataSize"]; !size.empty())
    require(voxels, std::stoull(size), there);
}

using GzipFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

/// What a .nii, compressed or not, takes by its header: values may be scaled to others than it stores. 0: by another
/// byte order or version of the header.
std::uint64_t nifti_bytes(const fs::path& file) {
  constexpr std::size_t header_size = 348, dim_at = 40, bits_at = 72, offset_at = 108;
  std::array<char, header_size> header{};
  const GzipFile in(gzopen(file.c_str(), "rb"), gzclose);
  if (!in || gzread(in.get(), header.data(), header_size) != static_cast<int>(header_size)) return 0;
  const auto get = [&](std::size_t at, auto value) {
    std::memcpy(&value, header.data() + at, sizeof(value));
    return value;
  };
  if (get(0, std::int32_t{}) != static_cast<std::int32_t>(header_size)) return 0;
  std::uint64_t voxels = 1;
  for (int axis = 1; axis <= std::clamp<int>(get(dim_at, std::int16_t{}), 0, 7); ++axis)
    voxels *= std::max<std::uint16_t>(1, get(dim_at + 2 * static_cast<std::size_t>(axis), std::uint16_t{}));
  return voxels * get(bits_at, std::uint16_t{}) / 8 + static_cast<std::uint64_t>(get(offset_at, float{}));
}

/// Reads it to its end: a compressed file does not say how long it should be.
void check_gzip(const fs::path& file, std::uint64_t bytes) {
  const GzipFile in(gzopen(file.c_str(), "rb"), gzclose);
  std::vector<char> buffer(1 << 20);
  std::uint64_t there = 0;
  int count = 0;
  while (in && (count = gzread(in.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
    there += static_cast<std::uint64_t>(count);
  int state = Z_OK;
  if (in) gzerror(in.get(), &state);
  if (!in || count < 0 || (state != Z_OK && state != Z_STREAM_END))
    throw input_error("{}: its compressed voxels cannot be read to their end: cut short?", file.string());
  require(file, bytes, there);
}

}  // namespace

void check_length(const fs::path& file, std::uint64_t bytes) {
  const std::string name = file.filename().string();
  if (name.ends_with(".mha") || name.ends_with(".mhd")) check_meta(file, bytes);
  if (name.ends_with(".nii")) require(file, nifti_bytes(file), fs::file_size(file));
  if (name.ends_with(".nii.gz")) check_gzip(file, nifti_bytes(file));
}

}  // namespace tether
