#include "common/config/case_file.hpp"

#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/reader.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

/// The unit system must be known before anything else is read. A wrong name is reported later, by the declaration of
/// `units`.
UnitSystem units_of(const YamlNode& tree) {
  const YamlNode* units = tree.find("units");
  try {
    return units ? UnitSystem::named(units->text) : UnitSystem::cgs();
  } catch (const InputError&) {
    return UnitSystem::cgs();
  }
}

/// The nodes on the way to "fluid.inlets.inlet", one per word; null from the first that the file leaves out.
std::vector<const YamlNode*> chain(const YamlNode& tree, std::string_view field) {
  std::vector<const YamlNode*> nodes;
  const YamlNode* node = &tree;
  for (std::size_t begin = 0; begin <= field.size();) {
    const std::size_t end = std::min(field.find('.', begin), field.size());
    node = node ? node->find(field.substr(begin, end - begin)) : nullptr;
    nodes.push_back(node);
    begin = end + 1;
  }
  return nodes;
}

}  // namespace

struct CaseFile::Contents {
  std::filesystem::path path;
  YamlNode tree;
  UnitSystem units;
  Problems problems;
  Reader reader;
  CommonCase common;

  explicit Contents(const std::filesystem::path& file)
      : path(file), tree(read_case_tree(file)), units(units_of(tree)), reader(tree, units, problems) {}
};

CaseFile::CaseFile(const std::filesystem::path& file) : contents_(std::make_unique<Contents>(file)) {
  if (contents_->tree.kind == YamlNode::Kind::scalar || contents_->tree.kind == YamlNode::Kind::list)
    throw input_error("{}: a case file is a section of named fields, such as 'name: tube'",
                      contents_->tree.place.text());
  contents_->common.declare(contents_->reader);
}

CaseFile::~CaseFile() = default;

const CommonCase& CaseFile::common() const {
  return contents_->common;
}
const UnitSystem& CaseFile::units() const {
  return contents_->units;
}
const std::filesystem::path& CaseFile::path() const {
  return contents_->path;
}
Fields& CaseFile::fields() {
  return contents_->reader;
}

void CaseFile::finish() {
  std::vector<std::string> known;
  for (const auto& section : top_level_sections()) known.emplace_back(section.name);
  for (const auto& entry : contents_->tree.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string near = nearest(entry.key, known);
    contents_->problems.add(entry.place, fmt::format("{}: unknown section; {}", entry.key,
                                                     near.empty() ? "known are " + listed(known)
                                                                  : fmt::format("did you mean '{}'?", near)));
  }
  contents_->problems.throw_if_any();
}

std::string CaseFile::given(std::string_view field) const {
  const auto found = chain(contents_->tree, field);
  return found.back() ? found.back()->text : "";
}

bool CaseFile::has(std::string_view field) const {
  const auto found = chain(contents_->tree, field);
  return found.back() && found.back()->kind != YamlNode::Kind::empty;
}

std::string CaseFile::where(std::string_view field) const {
  const YamlNode* nearest = &contents_->tree;
  for (const YamlNode* node : chain(contents_->tree, field))
    if (node) nearest = node;
  return fmt::format("{}: {}", nearest->place.text(), field);
}

}  // namespace tether
