#include "common/config/identified_parameters.hpp"

#include "common/config/case_tree.hpp"

namespace tether {

std::vector<IdentifiedParameter> identified_parameters(const std::filesystem::path& case_file) {
  std::vector<IdentifiedParameter> all;
  const YamlNode tree = read_case_tree(case_file);
  const YamlNode* section = tree.find("identification");
  const YamlNode* parameters = section != nullptr ? section->find("parameters") : nullptr;
  if (parameters == nullptr) return all;
  for (const auto& entry : parameters->entries) {
    IdentifiedParameter& parameter = all.emplace_back(IdentifiedParameter{entry.key, {}});
    if (const YamlNode* of = entry.value.find("of"))
      for (const YamlNode& number : of->items) parameter.of.push_back(number.text);
  }
  return all;
}

}  // namespace tether
