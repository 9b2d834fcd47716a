#include "vessel/image/image_check.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
#include "vessel/image/text_header.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Bytes of voxels: those of a tomography of a whole body, 512 x 512 x 2000 of two bytes, and some more.
constexpr std::uint64_t largest_image = 1'200'000'000;

void require(const fs::path& file, std::uint64_t wanted, std::uint64_t there) {
  if (std::min(wanted, there) > largest_image)
    throw input_error("{}: its voxels take {:.0f} MB: more than the {} MB that are read here; crop it", file.string(),
                      static_cast<double>(wanted) / 1e6, largest_image / 1'000'000);
  if (there < wanted)
    throw input_error("{}: its voxels take {} bytes, it has {}: cut short?", file.string(), wanted, there);
}

/// A header that states too little cuts the image silently.
void require_all(const fs::path& file, std::uint64_t wanted, std::uint64_t there, const char* remedy) {
  require(file, wanted, there);
  if (there > wanted)
    throw input_error("{}: its voxels take {} bytes by its header, it has {}: must be as many{}", file.string(), wanted,
                      there, remedy);
}

InputError no_image(const fs::path& file) {
  return input_error("{}: is not an image of the kind that its ending says", file.string());
}

/// Or the largest number, if it is larger.
std::uint64_t product(const std::vector<std::uint64_t>& factors) {
  std::uint64_t all = 1;
  for (const std::uint64_t factor : factors)
    if (__builtin_mul_overflow(all, factor, &all)) return UINT64_MAX;
  return all;
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  return a + std::min(b, UINT64_MAX - a);
}

using TypeSizes = std::map<std::string, std::uint64_t>;

/// Bytes of a voxel's number, by a format's names of types.
std::uint64_t type_size(const TextHeader& header, const std::string& field, const TypeSizes& sizes) {
  const auto found = sizes.find(header.get(field));
  if (found == sizes.end()) header.refuse(field, "is no type of numbers that can be read");
  return found->second;
}

constexpr std::uint64_t most_voxels = 1U << 31;  ///< along one axis

/// The bytes of a file from some place on.
struct Place {
  fs::path file;
  std::uint64_t from = 0;
  std::uint64_t size() const { return fs::file_size(file) - from; }
};

/// The file of voxels that a header names, beside it.
Place beside(const fs::path& file, const std::string& name) {
  const fs::path voxels = file.parent_path() / name;
  std::error_code none;  // a name that no file can have
  if (fs::is_regular_file(voxels, none)) return {voxels};
  throw input_error("{}: names the file {}, which is {}", file.string(), shortened(name),
                    !fs::exists(voxels, none)        ? "not there"
                    : fs::is_directory(voxels, none) ? "a folder"
                                                     : "a device or a pipe");
}

/// As many numbers as voxels, where they are written as text.
void require_numbers(const Place& place, std::uint64_t wanted) {
  constexpr std::uint64_t least = 2;  // a digit and a blank
  require(place.file, product({wanted, least}) - 1, place.size());
  std::ifstream in(place.file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(place.from));
  std::uint64_t there = 0;
  bool in_number = false;
  for (auto c = std::istreambuf_iterator<char>(in); c != std::istreambuf_iterator<char>(); ++c) {
    const bool is_blank = std::isspace(static_cast<unsigned char>(*c)) != 0 || *c == ',';
    there += !is_blank && !in_number ? 1 : 0;
    in_number = !is_blank;
  }
  if (there != wanted)
    throw input_error("{}: has {} numbers, its header states {}", place.file.string(), there, wanted);
}

using GzipFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

/// What compressed bytes become, of zlib's form or gzip's: they are read to their end, which a header does not tell, or
/// until they are more than are read here.
std::uint64_t inflated_size(const Place& place) {
  std::ifstream in(place.file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(place.from));
  std::vector<char> from(1 << 16), to(1 << 18);
  z_stream stream{};
  constexpr int either_form = MAX_WBITS + 32;
  inflateInit2(&stream, either_form);
  std::uint64_t size = 0;
  bool whole = false;  // what may stand behind the end is no more of it
  int state = Z_OK;
  while (state == Z_OK || state == Z_BUF_ERROR) {
    if (stream.avail_in == 0) {
      in.read(from.data(), static_cast<std::streamsize>(from.size()));
      stream.next_in = reinterpret_cast<Bytef*>(from.data());
      stream.avail_in = static_cast<uInt>(in.gcount());
      if (stream.avail_in == 0) break;
    }
    stream.next_out = reinterpret_cast<Bytef*>(to.data());
    stream.avail_out = static_cast<uInt>(to.size());
    state = inflate(&stream, Z_NO_FLUSH);
    size += to.size() - stream.avail_out;
    whole |= state == Z_STREAM_END || size > largest_image;
    if (size > largest_image) break;  // of zeros a small file holds any number
    if (state == Z_STREAM_END && (stream.avail_in > 0 || in.peek() != EOF)) state = inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (!whole)
    throw input_error("{}: its compressed voxels cannot be read to their end: cut short?", place.file.string());
  return size;
}

/// "Name = value" up to the line that says where the voxels are.
TextHeader meta_header(const fs::path& file) {
  TextHeader header(file, 250);  // MetaIO keeps them in arrays of 255 characters
  while (!header.has("ElementDataFile")) {
    const auto line = header.next();
    if (!line) header.fail("the file ends before ElementDataFile");
    const auto equals = line->find_first_of("=:");
    if (equals == std::string::npos) header.fail("Name = value was expected");
    header.add(trimmed(line->substr(0, equals)), trimmed(line->substr(equals + 1)));
  }
  return header;
}

const TypeSizes meta_types{{"MET_CHAR", 1},  {"MET_UCHAR", 1},     {"MET_SHORT", 2},      {"MET_USHORT", 2},
                           {"MET_INT", 4},   {"MET_UINT", 4},      {"MET_LONG", 4},       {"MET_ULONG", 4},
                           {"MET_FLOAT", 4}, {"MET_LONG_LONG", 8}, {"MET_ULONG_LONG", 8}, {"MET_DOUBLE", 8}};

/// Spacings are positive: of others MetaIO makes a mirrored image, or tells a false cause.
void check_geometry(const TextHeader& header, std::size_t axes) {
  const auto check = [&](const char* name, std::size_t numbers, bool positive) {
    if (!header.has(name)) return;
    const std::vector<double> all = header.lengths(name);
    if (all.size() != numbers) header.refuse(name, fmt::format("must be {} numbers", numbers));
    if (positive && *std::min_element(all.begin(), all.end()) <= 0) header.refuse(name, "must be positive");
  };
  for (const char* name : {"ElementSpacing", "ElementSize"}) check(name, axes, true);
  for (const char* name : {"Offset", "Position", "Origin", "CenterOfRotation"}) check(name, axes, false);
  for (const char* name : {"TransformMatrix", "Rotation", "Orientation"}) check(name, axes * axes, false);
}

/// ITK reads all lengths as millimetres, and values as they stand.
void check_units(const TextHeader& header) {
  if (const std::string unit = header.get("DistanceUnits"); !unit.empty() && unit != "mm" && unit != "?")
    header.refuse("DistanceUnits", "must be mm: save the image with its lengths in that unit");
  for (const auto& [name, plain] :
       {std::pair{"ElementToIntensityFunctionSlope", 1.0}, {"ElementToIntensityFunctionOffset", 0.0}})
    if (header.has(name) && header.lengths(name) != std::vector{plain})
      header.refuse(name, fmt::format("must be {:g}: save the image with its values as they are meant", plain));
}

void check_meta(const fs::path& file) {
  TextHeader header = meta_header(file);
  const std::string data = header.get("ElementDataFile");
  if (data.empty() || data == "LIST" || data.find('%') != std::string::npos)
    header.refuse("ElementDataFile", "must be LOCAL or one file");
  std::vector<std::uint64_t> factors = header.counts("DimSize", 1, most_voxels);
  if (factors.size() != header.count("NDims", 1, 10)) header.refuse("DimSize", "must be NDims numbers");
  check_geometry(header, factors.size());
  check_units(header);
  if (header.has("ElementNumberOfChannels")) factors.push_back(header.count("ElementNumberOfChannels", 1, 1000));
  factors.push_back(type_size(header, "ElementType", meta_types));
  const auto is_true = [&](const char* name, const char* absent) {
    const std::string value = header.has(name) ? header.get(name) : absent;
    return !value.empty() && std::string("Tt1").find(value[0]) != std::string::npos;
  };
  const Place voxels = data == "LOCAL" ? Place{file, header.end()} : beside(file, data);
  if (!is_true("BinaryData", "True")) {
    factors.pop_back();
    return require_numbers(voxels, product(factors));
  }
  const bool skips = header.has("HeaderSize") && header.get("HeaderSize") != "-1";
  const std::uint64_t wanted = product(factors), skipped = skips ? header.count("HeaderSize", 0, most_voxels) : 0;
  const bool is_compressed = is_true("CompressedData", "False");
  if (!is_compressed && header.has("HeaderSize")) return require(voxels.file, sum(wanted, skipped), voxels.size());
  if (!is_compressed)
    return require_all(voxels.file, wanted, voxels.size(), data == "LOCAL" ? "" : ", or HeaderSize be given");
  if (header.has("CompressedDataSize"))
    require(voxels.file, header.count("CompressedDataSize", 1, UINT64_MAX), voxels.size());
  require_all(voxels.file, wanted, inflated_size(voxels), "");
}

/// teem's messages of fields that it does not know overwrite its stack from about a thousand characters on.
constexpr std::size_t longest_nrrd_field = 500;

/// teem takes "Data File" for "datafile".
std::string nrrd_name(std::string name) {
  std::erase(name, ' ');
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// teem knows what directions and places mean only once it knows their space.
bool needs_space(const std::string& name) {
  return name == "spacedirections" || name == "spaceorigin" || name == "spaceunits" || name == "measurementframe";
}

/// "name: value" up to an empty line, or the end of a header that stands alone.
TextHeader nrrd_header(const fs::path& file) {
  TextHeader header(file, 1 << 20);  // 3D Slicer tells much of segments
  if (!header.next().value_or("").starts_with("NRRD000")) throw no_image(file);
  for (auto line = header.next(); line && !trimmed(*line).empty(); line = header.next()) {
    const auto colon = line->find(':');
    if (line->starts_with('#') || line->substr(colon == std::string::npos ? 0 : colon).starts_with(":=")) continue;
    if (colon == std::string::npos) header.fail("name: value was expected");
    if (line->size() > longest_nrrd_field)
      header.fail(fmt::format("a field of no more than {} characters was expected", longest_nrrd_field));
    const std::string name = nrrd_name(line->substr(0, colon));
    if (needs_space(name) && !header.has("space") && !header.has("spacedimension"))
      header.fail(fmt::format("{} stands before a space: must be behind one", line->substr(0, colon)));
    header.add(name, trimmed(line->substr(colon + 1)));
  }
  return header;
}

TypeSizes nrrd_types() {
  TypeSizes sizes{{"signed char", 1}, {"uchar", 1}, {"unsigned char", 1}, {"float", 4}, {"double", 8}};
  const auto add = [&](const std::string& name, std::uint64_t size) {
    for (const char* sign : {"", "signed ", "unsigned "})
      for (const char* end : {"", " int"}) sizes.emplace(sign + name + end, size);
    std::string joined = "u" + name;
    std::erase(joined, ' ');
    sizes.emplace(joined, size), sizes.emplace(joined.substr(1), size);
  };
  add("short", 2), add("long long", 8);
  for (const char* name : {"int", "signed int", "uint", "unsigned int"}) sizes.emplace(name, 4);
  for (const std::uint64_t size : {1, 2, 4, 8})
    for (const char* sign : {"", "u"})
      for (const char* end : {"", "_t"}) sizes.emplace(fmt::format("{}int{}{}", sign, 8 * size, end), size);
  return sizes;
}

/// Directions may be any that are not zero, or none of an axis that is none of space; so is a spacing nan.
void check_nrrd_geometry(const TextHeader& header, std::size_t axes) {
  const std::vector<double> spacings = header.lengths("spacings", axes > 3);
  if (std::any_of(spacings.begin(), spacings.end(), [](double spacing) { return spacing <= 0; }))
    header.refuse("spacings", "must be positive");
  header.lengths("spaceorigin");
  std::istringstream vectors(header.get("spacedirections"));
  for (std::string vector; std::getline(vectors, vector, ')');) {
    const auto open = vector.find('(');
    if (open == std::string::npos) continue;
    const auto parts = lengths_of(vector.substr(open));
    if (!parts || std::all_of(parts->begin(), parts->end(), [](double part) { return part == 0; }))
      header.refuse("spacedirections", "must be vectors of finite numbers that are not zero");
  }
}

/// teem knows units, ITK reads all lengths as millimetres. Axes that are none of space have other units, or none.
void check_nrrd_units(const TextHeader& header) {
  static const std::set<std::string> known{"mm", "millimeter", "millimeters", "", "none", "???", "s", "ms"};
  for (const char* field : {"spaceunits", "units"}) {
    std::istringstream text(header.get(field));
    for (std::string unit; text >> std::quoted(unit);)
      if (!known.contains(unit)) header.refuse(field, "must be mm: save the image with its lengths in that unit");
  }
}

void check_nrrd(const fs::path& file) {
  TextHeader header = nrrd_header(file);
  std::vector<std::uint64_t> factors = header.counts("sizes", 1, most_voxels);
  if (factors.size() != header.count("dimension", 1, 16)) header.refuse("sizes", "must be as many as the dimension");
  check_nrrd_geometry(header, factors.size());
  check_nrrd_units(header);
  factors.push_back(type_size(header, "type", nrrd_types()));
  const std::string data = header.get("datafile");
  if (data == "LIST" || data.find('%') != std::string::npos) header.refuse("datafile", "must be one file");
  const Place voxels = data.empty() ? Place{file, header.end()} : beside(file, data);
  for (const char* skip : {"lineskip", "byteskip"})
    if (header.has(skip) && header.get(skip) != "0" && header.get(skip) != "-1") header.refuse(skip, "must be 0 or -1");
  const std::string encoding = header.get("encoding");
  const bool from_the_end = header.get("byteskip") == "-1";
  if (encoding == "raw" && from_the_end) return require(voxels.file, product(factors), voxels.size());
  if (encoding == "raw") return require_all(voxels.file, product(factors), voxels.size(), "");
  if (encoding == "gzip" || encoding == "gz")
    return require_all(voxels.file, product(factors), inflated_size(voxels), "");
  if (encoding != "hex" && encoding != "ascii" && encoding != "text" && encoding != "txt")
    header.refuse("encoding", "must be raw, gzip, ascii or hex");
  if (encoding == "hex") return require(voxels.file, product({product(factors), 2}), voxels.size());
  factors.pop_back();
  require_numbers(voxels, product(factors));
}

/// The beginning of a .nii, compressed or not, in either order of bytes.
class NiftiHeader {
 public:
  NiftiHeader(const fs::path& file, bool may_be_compressed) {
    const GzipFile in(gzopen(file.c_str(), "rb"), gzclose);
    if (!in || !(may_be_compressed || gzdirect(in.get())) ||
        gzread(in.get(), bytes_.data(), size) != static_cast<int>(size) ||
        (!is_size() && (swapped_ = true, !is_size())) || std::memcmp(bytes_.data() + 344, "n+1", 4) != 0)
      throw no_image(file);
  }
  template <class Number>
  Number get(std::size_t at) const {
    std::array<char, sizeof(Number)> its;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at), its.size(), its.begin());
    if (swapped_) std::reverse(its.begin(), its.end());
    return std::bit_cast<Number>(its);
  }

 private:
  static constexpr unsigned size = 348;
  bool is_size() const { return get<std::int32_t>(0) == static_cast<std::int32_t>(size); }

  std::array<char, size> bytes_{};
  bool swapped_ = false;
};

/// Before the spacings stands -1 or 1, how the quaternion turns.
void check_geometry(const fs::path& file, const NiftiHeader& header) {
  constexpr std::size_t spacing_at = 76, quaternion_at = 256, rows_end = 328;
  const auto check = [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; at += sizeof(float))
      if (const auto number = header.get<float>(at); !is_length(number))
        throw input_error("{}: its header states a place or an axis of {:g}", file.string(), number);
  };
  check(spacing_at, spacing_at + 4 * sizeof(float));
  check(quaternion_at, rows_end);
  for (std::size_t axis = 1; axis <= 3; ++axis)
    if (const auto spacing = header.get<float>(spacing_at + axis * sizeof(float)); spacing <= 0)
      throw input_error("{}: pixdim[{}]: {:g}: must be positive", file.string(), axis, spacing);
}

/// ITK turns spacings into millimetres, but not the places that stand beside them.
void check_units(const fs::path& file, const NiftiHeader& header) {
  constexpr std::size_t units_at = 123;
  constexpr int of_space = 7, millimetre = 2;
  static const std::map<int, std::string> known{{1, "metres"}, {3, "micrometres"}};
  const int unit = header.get<std::uint8_t>(units_at) & of_space;
  if (unit == 0 || unit == millimetre) return;
  const auto found = known.find(unit);
  throw input_error(
      "{}: xyzt_units: its lengths are {}: must be millimetres (2): save the image with its lengths in "
      "that unit",
      file.string(), found == known.end() ? fmt::format("of the unit {}", unit) : found->second);
}

/// Spacings stand twice in a header, and ITK takes those of pixdim with the directions of the rows. Throws InputError
/// unless they are the same.
void check_spacings(const fs::path& file, const NiftiHeader& header) {
  constexpr std::size_t rows_are_meant_at = 254, spacing_at = 76, rows_at = 280, number = sizeof(float);
  constexpr double tolerance = 1e-3;
  if (header.get<std::int16_t>(rows_are_meant_at) <= 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double stated = header.get<float>(spacing_at + (axis + 1) * number);
    const auto part = [&](std::size_t row) -> double { return header.get<float>(rows_at + (4 * row + axis) * number); };
    const double spacing = std::hypot(part(0), part(1), part(2));
    if (std::abs(spacing - stated) > tolerance * stated)
      throw input_error(
          "{}: pixdim[{}]: {:g}: the sform (srow_x, srow_y, srow_z) has a spacing of {:g} there: must be "
          "the same",
          file.string(), axis + 1, stated, spacing);
  }
}

/// What it takes by its header.
std::uint64_t nifti_bytes(const fs::path& file, bool may_be_compressed) {
  constexpr std::size_t dimensions_at = 40, type_at = 70, offset_at = 108;
  static const std::map<int, std::uint64_t> sizes{{2, 1},    {4, 2},    {8, 4},     {16, 4},  {32, 8},
                                                  {64, 8},   {128, 3},  {256, 1},   {512, 2}, {768, 4},
                                                  {1024, 8}, {1280, 8}, {1792, 16}, {2304, 4}};
  const NiftiHeader header(file, may_be_compressed);
  check_geometry(file, header);
  check_units(file, header);
  check_spacings(file, header);
  const auto dimension = [&](int axis) {
    return header.get<std::int16_t>(dimensions_at + 2 * static_cast<std::size_t>(axis));
  };
  const auto type = sizes.find(header.get<std::int16_t>(type_at));
  const auto offset = header.get<float>(offset_at);
  if (type == sizes.end()) throw input_error("{}: its voxels are of no type that can be read", file.string());
  if (dimension(0) < 1 || dimension(0) > 7 || !(offset >= 0 && offset < 1e9F))
    throw input_error("{}: its header states {} dimensions, and voxels from byte {:g} on", file.string(), dimension(0),
                      offset);
  std::vector<std::uint64_t> factors{type->second};
  for (int axis = 1; axis <= dimension(0); ++axis) {
    if (dimension(axis) < 1)
      throw input_error("{}: its header states {} voxels along axis {}", file.string(), dimension(axis), axis);
    factors.push_back(static_cast<std::uint64_t>(dimension(axis)));
  }
  return sum(product(factors), static_cast<std::uint64_t>(offset));
}

}  // namespace

void check_image(const fs::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto is = [&](const char* ending) { return name.ends_with(ending); };
  if (!fs::is_regular_file(file))
    throw input_error("{}: {}", file.string(), fs::exists(file) ? "is not a file" : "no such file");
  if (is(".mha") || is(".mhd")) return check_meta(file);
  if (is(".nrrd") || is(".nhdr")) return check_nrrd(file);
  if (is(".nii")) require_all(file, nifti_bytes(file, false), fs::file_size(file), "");
  if (is(".nii.gz")) require_all(file, nifti_bytes(file, true), inflated_size({file}), "");
}

}  // namespace tether
