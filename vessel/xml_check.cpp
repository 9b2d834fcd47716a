#include "vessel/xml_check.hpp"

#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/xml_tags.hpp"
#include "vessel/readers.hpp"
#include "vessel/xml_bytes.hpp"

namespace tether {

namespace {

/// Bytes: of zeros a small file holds any number. The cells of a million nodes take half of it.
constexpr std::uint64_t largest_array = 400'000'000;

constexpr std::uint64_t most_components = 1000;
constexpr std::size_t most_arrays = 1000;         ///< of a section of a piece: VTK looks for each among the others
constexpr std::uint64_t most_compression = 1100;  ///< zlib: 1032; blocks of the others are too small for more

/// Bytes of one number; 0: text, of any length. None: unknown.
std::optional<std::uint64_t> xml_type_size(std::string_view type) {
  static const std::map<std::string_view, std::uint64_t> sizes{
      {"Int8", 1},  {"UInt8", 1},  {"Int16", 2},   {"UInt16", 2},  {"Int32", 4}, {"UInt32", 4},
      {"Int64", 8}, {"UInt64", 8}, {"Float32", 4}, {"Float64", 8}, {"String", 0}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint64_t> xml_count(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// How many of everything a piece states.
using XmlPiece = std::map<std::string, std::uint64_t, std::less<>>;

struct XmlArray {
  XmlTag tag;
  std::string section;      ///< that it stands in: Points, PointData, Polys ...
  std::size_t piece;        ///< number of the piece
  std::uint64_t type_size;  ///< bytes of a number
  std::uint64_t components;
  std::string name() const { return std::string(tag.attribute("Name", section)); }
};

/// The blocks of a compressed array, as its header states them.
struct XmlBlocks {
  std::vector<std::uint64_t> compressed, uncompressed;
};

class XmlCheck {
 public:
  XmlCheck(std::string name, const std::string& content) : content_(content), tags_(std::move(name), content) {}

  void run(const std::string& kind) {
    check_root(tags_.next(), kind);
    while (!appended_ && !tags_.at_end()) take(tags_.next());
    check_names();
    for (const XmlArray& array : arrays_)
      if (is_cells(array.section) && array.name() == "offsets") check_offsets(array);
    for (const XmlArray& array : arrays_) check_values(array);
  }

 private:
  void check_root(const XmlTag& tag, const std::string& kind) {
    kind_ = kind;
    if (tag.name != "VTKFile") tags_.fail(tag.begin, "is no VTK file: the first tag must be VTKFile");
    require_one_of(tag, "type", {kind});
    require_one_of(tag, "byte_order", {"", "LittleEndian", "BigEndian"});
    require_one_of(tag, "header_type", {"", "UInt32", "UInt64"});
    require_one_of(tag, "compressor", {"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"});
    big_endian_ = tag.attribute("byte_order") == "BigEndian";
    word_ = tag.attribute("header_type") == "UInt64" ? 8 : 4;
    compressor_ = tag.attribute("compressor");
    most_ = content_.size() * (compressor_.empty() ? 1 : most_compression);
  }

  void require_one_of(const XmlTag& tag, std::string_view name, const std::vector<std::string>& values) const {
    const std::string value(tag.attribute(name).substr(0, 40));
    if (std::find(values.begin(), values.end(), value) != values.end()) return;
    std::string allowed;
    for (const std::string& one : values)
      if (!one.empty()) allowed += (allowed.empty() ? "" : ", ") + one;
    refuse(tag, name, "must be " + allowed);
  }

  [[noreturn]] void refuse(const XmlTag& tag, std::string_view attribute, const std::string& why) const {
    tags_.fail(tag.begin, fmt::format("{}=\"{}\": {}", attribute, tag.attribute(attribute).substr(0, 40), why));
  }

  void take(const XmlTag& tag) {
    if (tag.closing) return;
    check_is_first(tag);
    for (const auto& [name, value] : tag.attributes)
      if (name.starts_with("NumberOf")) check_count(tag, name);
    if (tag.name == "Piece") {
      XmlPiece& piece = pieces_.emplace_back();
      for (const auto& [name, value] : tag.attributes)
        if (name.starts_with("NumberOf")) piece.emplace(name, *xml_count(value));
    } else if (tag.name == "DataArray" || tag.name == "Array") {
      take_name(tag);
      if (tag.name == "DataArray") take_array(tag);
    } else if (tag.name == "AppendedData") {
      require_one_of(tag, "encoding", {"", "raw", "base64"});
      appended_ = tag;
    }
  }

  /// VTK takes one of several, without a word; a file has one dataset, a piece one section of each kind.
  void check_is_first(const XmlTag& tag) {
    static const std::set<std::string_view> sections{"Points", "PointData", "CellData", "Verts",
                                                     "Lines",  "Polys",     "Strips",   "Cells"};
    const bool is_dataset = tag.name == kind_;
    if ((is_dataset || sections.contains(tag.name)) &&
        !seen_.emplace(is_dataset ? 0 : pieces_.size(), std::string(tag.name)).second)
      tags_.fail(tag.begin, fmt::format("a second {}{}: must be one", tag.name, is_dataset ? "" : " of a piece"));
  }

  void check_count(const XmlTag& tag, std::string_view name) const {
    const auto count = xml_count(tag.attribute(name));
    if (!count) refuse(tag, name, "must be a number, 0 or more");
    if (name == "NumberOfComponents") {
      if (*count < 1 || *count > most_components) refuse(tag, name, fmt::format("must be 1 to {}", most_components));
    } else if (*count > most_) {
      refuse(tag, name, fmt::format("the file has {} bytes", content_.size()));
    }
  }

  static bool is_cells(std::string_view section) {
    return section == "Verts" || section == "Lines" || section == "Polys" || section == "Strips" || section == "Cells";
  }

  /// That this tag stands in.
  std::string section_of(const XmlTag& tag) const {
    const auto& open = tags_.open();
    const std::size_t outside = open.size() - (tag.empty ? 0 : 1);
    return outside > 0 ? std::string(open[outside - 1]) : "";
  }

  /// VTK finds the arrays of data by their place among those of different names in the first piece.
  void take_name(const XmlTag& tag) {
    const std::string section = section_of(tag), name(section == "Points" ? section : tag.attribute("Name"));
    if (++arrays_in_[{pieces_.size(), section}] > most_arrays)
      tags_.fail(tag.begin, fmt::format("{} has more than {} arrays", section, most_arrays));
    if ((section == "Points" || is_cells(section)) && !names_[{pieces_.size(), section}].insert(name).second)
      tags_.fail(tag.begin, fmt::format("a second array {} of a piece: must be one", name.substr(0, 40)));
    if (section != "PointData" && section != "CellData") return;
    if (name.empty()) refuse(tag, "Name", "an array of data must have one");
    if (pieces_.size() > 1 && !names_[{1, section}].contains(name)) refuse(tag, "Name", "the first piece has none");
    if (!names_[{pieces_.size(), section}].insert(name).second) refuse(tag, "Name", "occurs twice");
  }

  /// Throws InputError unless each piece has the arrays of the first one.
  void check_names() {
    for (std::size_t piece = 2; piece <= pieces_.size(); ++piece)
      for (const std::string section : {"PointData", "CellData"})
        if (names_[{piece, section}].size() != names_[{1, section}].size())
          tags_.fail(content_.size(), fmt::format("piece {} has not all arrays {} of the first", piece, section));
  }

  void take_array(const XmlTag& tag) {
    XmlArray array{tag, section_of(tag), pieces_.size(), 0, 1};
    const auto size = xml_type_size(tag.attribute("type"));
    const bool geometry = is_geometry(array);
    if (!size || (geometry && *size == 0)) refuse(tag, "type", "no type of numbers that can be read");
    array.type_size = *size;
    require_one_of(tag, "format", {"ascii", "binary", "appended"});
    array.components = *xml_count(tag.attribute("NumberOfComponents", "1"));
    const std::uint64_t needed = array.section == "Points" ? 3 : 1;
    if (geometry && array.components != needed) refuse(tag, "NumberOfComponents", fmt::format("must be {}", needed));
    if (array.section == "Cells" && (array.name() == "faces" || array.name() == "faceoffsets"))
      tags_.fail(tag.begin, "polyhedra: only linear tetrahedra, wedges and surface cells can be read");
    arrays_.push_back(array);
  }

  std::uint64_t stated(const XmlArray& array, std::string_view what) const {
    if (array.piece == 0) return 0;
    const XmlPiece& piece = pieces_[array.piece - 1];
    const auto found = piece.find(what);
    return found == piece.end() ? 0 : found->second;
  }

  /// Tuples that VTK will read of it.
  std::uint64_t tuples(const XmlArray& array) const {
    if (array.section == "Points" || array.section == "PointData") return stated(array, "NumberOfPoints");
    if (array.section == "CellData")
      return stated(array, "NumberOfCells") + stated(array, "NumberOfVerts") + stated(array, "NumberOfLines") +
             stated(array, "NumberOfPolys") + stated(array, "NumberOfStrips");
    if (is_cells(array.section) && array.name() == "connectivity") {
      const auto found = last_offset_.find({array.piece, array.section});
      return found == last_offset_.end() ? 0 : found->second;
    }
    if (is_cells(array.section)) return stated(array, "NumberOf" + array.section);
    return xml_count(array.tag.attribute("NumberOfTuples", "0")).value_or(0);
  }

  [[noreturn]] void fail(const XmlArray& array, const std::string& what) const {
    tags_.fail(array.tag.begin, fmt::format("array {} of {}: {}", array.name().substr(0, 40), array.section, what));
  }

  void check_values(const XmlArray& array) const {
    const std::uint64_t values = tuples(array) * array.components;  // of most_ and most_components: no overflow
    const bool is_text = array.tag.attribute("format") == "ascii";
    if (array.type_size == 0 || values == 0) {
      const bool is_there = array.tag.attribute("format") == "appended" || !next_word_of(array).empty();
      if (!is_text && is_there) stated_bytes(array);  // VTK reads how long it is, needed or not
    } else if (is_text) {
      check_text(array, values);
    } else if (const std::uint64_t bytes = stated_bytes(array); bytes / array.type_size < values) {
      fail(array, fmt::format("{} values are needed, it has {} bytes", values, bytes));
    } else if (is_geometry(array) && bytes / array.type_size > values) {
      fail_more(array, values);
    } else if (!compressor_.empty() && values > largest_array / array.type_size) {
      fail(array, fmt::format("{} values: more than the {} MB that are read here", values, largest_array / 1'000'000));
    } else if (!compressor_.empty()) {
      data(array, values * array.type_size);  // VTK must not fail: telling so it follows a null pointer
    }
  }

  static bool is_geometry(const XmlArray& array) { return array.section == "Points" || is_cells(array.section); }

  /// What a piece does not state would be cut off.
  [[noreturn]] void fail_more(const XmlArray& array, std::uint64_t values) const {
    fail(array, fmt::format("{} values are stated by its piece, it has more: must be as many", values));
  }

  std::string_view text_of(const XmlArray& array) const {
    if (array.tag.empty) return {};
    const std::string_view behind = std::string_view(content_).substr(array.tag.end);
    return behind.substr(0, behind.find('<'));
  }

  std::string_view next_word_of(const XmlArray& array) const {
    std::string_view text = text_of(array);
    return next_word(text);
  }

  /// Throws InputError unless there are so many numbers.
  void check_text(const XmlArray& array, std::uint64_t values) const {
    std::string_view text = text_of(array);
    for (std::uint64_t i = 0; i < values; ++i) {
      const std::string_view word = next_word(text);
      if (word.empty()) fail(array, fmt::format("{} values are needed, it has {}", values, i));
      if (!is_value(array, word))
        tags_.fail(static_cast<std::size_t>(word.data() - content_.data()),
                   fmt::format("\"{}\" found where a number ({}) was expected", word.substr(0, 40),
                               array.tag.attribute("type")));
    }
    if (is_geometry(array) && !next_word(text).empty()) fail_more(array, values);
  }

  /// Whether VTK can read it as a number of the array's type.
  static bool is_value(const XmlArray& array, std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const std::string_view type = array.tag.attribute("type");
    if (type == "Float32") return is_number<float>(word);
    if (type == "Float64") return is_number<double>(word);
    if (type == "UInt64") return is_number<std::uint64_t>(word);
    if (!is_number<std::int64_t>(word)) return false;
    std::int64_t value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    const auto bits = static_cast<int>(8 * array.type_size);
    if (type.starts_with('U')) return value >= 0 && value >> bits == 0;
    return bits == 64 || value >> (bits - 1) == 0 || value >> (bits - 1) == -1;
  }

  template <class Number>
  static bool is_number(std::string_view word) {
    const bool named = word == "nan" || word == "inf" || word == "-inf";
    if (word.find_first_of("niNI") != std::string_view::npos) return named && std::is_floating_point_v<Number>;
    Number value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
  }

  /// Cuts it off.
  static std::string_view next_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    text.remove_prefix(word.size());
    return word;
  }

  /// Where a binary array begins.
  XmlBytes bytes_of(const XmlArray& array) const {
    if (array.tag.attribute("format") == "binary") {
      std::string_view text = text_of(array);
      text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
      return {text, true};
    }
    const auto offset = xml_count(array.tag.attribute("offset"));
    if (!offset) refuse(array.tag, "offset", "must be a number, 0 or more");
    if (!appended_) fail(array, "its data are appended, but the file has no AppendedData: cut short?");
    std::string_view data = std::string_view(content_).substr(appended_->end);
    data.remove_prefix(std::min(data.find_first_not_of(" \t\r\n"), data.size()));
    if (!data.starts_with('_')) fail(array, "the appended data do not begin with _: cut short?");
    if (*offset + 1 > data.size())
      refuse(array.tag, "offset", fmt::format("{} bytes are appended: cut short?", data.size()));
    return {data.substr(*offset + 1), appended_->attribute("encoding") != "raw"};
  }

  std::uint64_t header_word(std::string_view bytes, std::size_t i) const {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < word_; ++k)
      value |= std::uint64_t{static_cast<unsigned char>(bytes[i * word_ + (big_endian_ ? word_ - 1 - k : k)])} << 8 * k;
    return value;
  }

  std::string header(const XmlArray& array, const XmlBytes& bytes, std::uint64_t words) const {
    std::string header = words <= bytes.left() / word_ ? bytes.read(words * word_) : "";
    if (header.size() < words * word_) fail(array, "its data end in their header: cut short?");
    return header;
  }

  /// Bytes that an array has by its header, if the file has them.
  std::uint64_t stated_bytes(const XmlArray& array) const {
    XmlBytes bytes = bytes_of(array);
    std::uint64_t needed = word_, values = 0;
    if (compressor_.empty()) {
      values = header_word(header(array, bytes, 1), 0);
      if (values > bytes.left()) fail_short(array, values, bytes.left());
      needed += values;
    } else {
      const XmlBlocks blocks = blocks_of(array, bytes);
      values = std::reduce(blocks.uncompressed.begin(), blocks.uncompressed.end());
      needed = std::reduce(blocks.compressed.begin(), blocks.compressed.end());
    }
    if (const std::uint64_t found = bytes.count(needed); found < needed) fail_short(array, needed, found);
    return values;
  }

  [[noreturn]] void fail_short(const XmlArray& array, std::uint64_t stated, std::uint64_t found) const {
    fail(array, fmt::format("{} bytes are stated, it has {}: cut short?", stated, found));
  }

  /// Goes to the first block.
  XmlBlocks blocks_of(const XmlArray& array, XmlBytes& bytes) const {
    const std::string start = header(array, bytes, 3);
    const std::uint64_t blocks = header_word(start, 0), size = header_word(start, 1), last = header_word(start, 2);
    if (blocks > bytes.left() / word_ || last > size || (blocks > 0 && size == 0) || (blocks == 0 && last > 0))
      fail(array, fmt::format("its header states {} blocks of {} bytes, the last one of {}", blocks, size, last));
    const std::string all = header(array, bytes, 3 + blocks);
    bytes.skip(all.size());
    XmlBlocks found;
    std::uint64_t left = bytes.left();
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::uint64_t compressed = header_word(all, 3 + i);
      const std::uint64_t uncompressed = i + 1 == blocks && last > 0 ? last : size;
      if (compressed > left || uncompressed / most_compression > compressed)
        fail(array, fmt::format("block {} (from 0) has {} bytes, {} uncompressed, where {} are left: cut short?", i,
                                compressed, uncompressed, left));
      left -= compressed;
      found.compressed.push_back(compressed);
      found.uncompressed.push_back(uncompressed);
    }
    return found;
  }

  /// The numbers of an array of offsets, which must end where the nodes of each cell end.
  void check_offsets(const XmlArray& array) {
    const std::uint64_t cells = tuples(array);
    if (cells == 0) return;
    check_values(array);
    const std::vector<std::int64_t> offsets = integers(array, cells);
    std::int64_t before = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      if (offsets[i] < before || static_cast<std::uint64_t>(offsets[i]) > most_)
        fail(array, fmt::format("the nodes of cell {} (from 0) end at {}, those of the one before at {}", i, offsets[i],
                                before));
      before = offsets[i];
    }
    last_offset_[{array.piece, array.section}] = static_cast<std::uint64_t>(before);
  }

  std::vector<std::int64_t> integers(const XmlArray& array, std::uint64_t count) const {
    std::vector<std::int64_t> values;
    if (array.tag.attribute("format") == "ascii") {
      std::string_view text = text_of(array);
      while (values.size() < count) values.push_back(text_integer(array, next_word(text)));
      return values;
    }
    const std::string bytes = data(array, count * array.type_size);
    for (std::size_t i = 0; i < count; ++i) values.push_back(raw_integer(array, bytes, i));
    return values;
  }

  std::int64_t text_integer(const XmlArray& array, std::string_view word) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(array, fmt::format("\"{}\" is no integer", word.substr(0, 40)));
    return value;
  }

  std::int64_t raw_integer(const XmlArray& array, const std::string& bytes, std::size_t i) const {
    std::uint64_t value = 0;
    const std::size_t size = array.type_size;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t at = i * size + (big_endian_ ? size - 1 - k : k);
      value |= std::uint64_t{static_cast<unsigned char>(bytes[at])} << 8 * k;
    }
    return static_cast<std::int64_t>(value);
  }

  /// The first bytes of a binary array whose header is right.
  std::string data(const XmlArray& array, std::uint64_t bytes) const {
    XmlBytes source = bytes_of(array);
    std::string data;
    if (compressor_.empty()) {
      data = source.read(word_ + bytes).substr(word_);
    } else {
      const XmlBlocks blocks = blocks_of(array, source);
      const std::string compressed = source.read(std::reduce(blocks.compressed.begin(), blocks.compressed.end()));
      for (std::size_t i = 0, at = 0; i < blocks.compressed.size() && data.size() < bytes; ++i) {
        if (at > compressed.size()) break;
        data += uncompressed(array, compressed.substr(at, blocks.compressed[i]), blocks.uncompressed[i]);
        at += blocks.compressed[i];
      }
    }
    if (data.size() < bytes) fail(array, fmt::format("{} bytes are needed, it has {}", bytes, data.size()));
    return data;
  }

  std::string uncompressed(const XmlArray& array, const std::string& block, std::uint64_t size) const {
    std::string data(size, '\0');
    const auto compressor = make_compressor();
    const auto* from = reinterpret_cast<const unsigned char*>(block.data());
    if (compressor->Uncompress(from, block.size(), reinterpret_cast<unsigned char*>(data.data()), size) != size)
      fail(array, "its data cannot be uncompressed");
    return data;
  }

  vtkSmartPointer<vtkDataCompressor> make_compressor() const {
    if (compressor_ == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    if (compressor_ == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
    return vtkSmartPointer<vtkZLibDataCompressor>::New();
  }

  const std::string& content_;
  XmlTags tags_;
  bool big_endian_ = false;
  std::size_t word_ = 4;    ///< bytes of the numbers in the headers of binary arrays
  std::string kind_;        ///< of the dataset
  std::string compressor_;  ///< empty: none
  std::uint64_t most_ = 0;  ///< of anything that the file can hold
  std::vector<XmlPiece> pieces_;
  std::vector<XmlArray> arrays_;
  std::map<std::pair<std::size_t, std::string>, std::set<std::string>> names_;  ///< of arrays, by piece and section
  std::map<std::pair<std::size_t, std::string>, std::size_t> arrays_in_;        ///< how many, by piece and section
  std::set<std::pair<std::size_t, std::string>> seen_;                          ///< the dataset, and sections by piece
  std::optional<XmlTag> appended_;
  std::map<std::pair<std::size_t, std::string>, std::uint64_t> last_offset_;  ///< by piece and section
};

}  // namespace

void check_xml_vtk(const std::filesystem::path& path, const std::string& kind) {
  const std::string content = file_content(path);
  XmlCheck(path.string(), content).run(kind);
}

}  // namespace tether
