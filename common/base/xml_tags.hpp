#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tether {

/// A tag of an XML file, with its place in the file.
struct XmlTag {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;
  std::size_t begin, end;  ///< of the tag; behind end stands what it holds
  bool closing, empty;     ///< </name>, <name/>

  std::string_view attribute(std::string_view name, std::string_view if_absent = {}) const;
};

/// Goes through the tags of an XML file, and knows those that are open. No more of XML than VTK's files have, and no
/// more of each than VTK's parser takes in short time.
class XmlTags {
 public:
  XmlTags(std::string name, std::string_view content) : name_(std::move(name)), content_(content) {}

  /// Throws InputError with the line: no tag, cut short, closes another than the open one, more than any file has.
  XmlTag next();
  /// Nothing but blanks and comments is left. Throws InputError if a tag is still open.
  bool at_end();
  /// From outside to inside, with a last tag that is not empty.
  const std::vector<std::string_view>& open() const { return open_; }

  [[noreturn]] void fail(std::size_t place, const std::string& what) const;

 private:
  void skip_to_tag();
  void skip_behind(std::string_view what);
  void read_attributes(XmlTag& tag);
  void add_attribute(XmlTag& tag, std::string_view name, std::string_view value) const;
  void follow(const XmlTag& tag);
  std::string_view letters_until(std::string_view ends);
  void skip_blanks();

  std::string name_;
  std::string_view content_;
  std::size_t position_ = 0;
  std::size_t tags_ = 0;  ///< so far
  std::vector<std::string_view> open_;
};

}  // namespace tether
