#include "common/base/xml_tags.hpp"

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {

namespace {
constexpr std::string_view xml_blanks = " \t\r\n";
constexpr std::size_t most_open_tags = 50;     // VTK goes through them by recursion
constexpr std::size_t most_tags = 250'000;     ///< VTK takes 2 kB for each; a series has up to 100,000 files
constexpr std::size_t most_attributes = 100;   ///< of a tag: VTK looks for each among the others
constexpr std::size_t longest_value = 65'536;  ///< bytes: VTK copies it with each &amp; in it
}  // namespace

std::string_view XmlTag::attribute(std::string_view name, std::string_view if_absent) const {
  const auto found = attributes.find(name);
  return found == attributes.end() ? if_absent : found->second;
}

void XmlTags::fail(std::size_t place, const std::string& what) const {
  const auto before = content_.substr(0, place);
  throw input_error("{}:{}: {}", name_, 1 + std::count(before.begin(), before.end(), '\n'), what);
}

void XmlTags::skip_blanks() {
  position_ = std::min(content_.find_first_not_of(xml_blanks, position_), content_.size());
}

void XmlTags::skip_behind(std::string_view what) {
  const std::size_t found = content_.find(what, position_);
  if (found == std::string_view::npos) fail(position_, fmt::format("{} is missing: cut short?", what));
  position_ = found + what.size();
}

void XmlTags::skip_to_tag() {
  for (;;) {
    position_ = std::min(content_.find('<', position_), content_.size());
    const std::string_view rest = content_.substr(position_);
    if (rest.starts_with("<!--")) {
      skip_behind("-->");
    } else if (rest.starts_with("<?")) {
      skip_behind("?>");
    } else {
      return;
    }
  }
}

bool XmlTags::at_end() {
  skip_to_tag();
  if (position_ < content_.size()) return false;
  if (!open_.empty()) fail(position_, fmt::format("the file ends before </{}>: cut short?", open_.back()));
  return true;
}

std::string_view XmlTags::letters_until(std::string_view ends) {
  const std::size_t begin = position_;
  position_ = std::min(content_.find_first_of(ends, begin), content_.size());
  return content_.substr(begin, position_ - begin);
}

XmlTag XmlTags::next() {
  skip_to_tag();
  if (position_ == content_.size()) fail(position_, "a tag was expected");
  XmlTag tag{{}, {}, position_, 0, false, false};
  ++position_;
  tag.closing = content_.substr(position_).starts_with('/');
  if (tag.closing) ++position_;
  tag.name = letters_until(" \t\r\n/><=\"");
  if (tag.name.empty() || tag.name[0] == '!') fail(tag.begin, "no tag that a VTK file can have");
  if (++tags_ > most_tags) fail(tag.begin, fmt::format("has more than {} tags", most_tags));
  read_attributes(tag);
  follow(tag);
  return tag;
}

void XmlTags::read_attributes(XmlTag& tag) {
  for (;;) {
    skip_blanks();
    const std::string_view rest = content_.substr(position_);
    tag.empty = rest.starts_with("/>");
    if (tag.empty || rest.starts_with('>')) break;
    const std::string_view name = letters_until(" \t\r\n/><=\"");
    skip_blanks();
    const std::string_view value = content_.substr(position_);
    if (name.empty() || value.size() < 2 || value[0] != '=') fail(tag.begin, "a tag is not whole: cut short?");
    ++position_;
    skip_blanks();
    const char quote = position_ < content_.size() ? content_[position_] : ' ';
    const std::size_t end =
        quote == '"' || quote == '\'' ? content_.find(quote, position_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail(tag.begin, fmt::format("{} has no value in quotes", name.substr(0, 40)));
    add_attribute(tag, name, content_.substr(position_ + 1, end - position_ - 1));
    position_ = end + 1;
  }
  position_ += tag.empty ? 2 : 1;
  tag.end = position_;
}

void XmlTags::add_attribute(XmlTag& tag, std::string_view name, std::string_view value) const {
  if (value.size() > longest_value)
    fail(tag.begin, fmt::format("the value of {} has more than {} bytes", name.substr(0, 40), longest_value));
  tag.attributes[name] = value;
  if (tag.attributes.size() > most_attributes)
    fail(tag.begin, fmt::format("a tag has more than {} attributes", most_attributes));
}

void XmlTags::follow(const XmlTag& tag) {
  if (tag.closing) {
    if (open_.empty() || open_.back() != tag.name)
      fail(tag.begin, fmt::format("</{}> closes no open tag", tag.name.substr(0, 40)));
    open_.pop_back();
  } else if (!tag.empty) {
    if (open_.size() == most_open_tags) fail(tag.begin, "too many tags in each other");
    open_.push_back(tag.name);
  }
}

}  // namespace tether
