#include "fsi_master/untold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "common/base/checked_file.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"

namespace tether {
namespace {

/// Sections that no code of fluid or wall reads to compute a step, or whose part in it is told otherwise.
constexpr std::array not_of_codes{"name",           "title",     "time",     "image",  "twin",     "observations",
                                  "identification", "diagnosis", "observer", "output", "coupling", "initial_state"};

bool may_be_read(std::string_view section) {
  return std::find(not_of_codes.begin(), not_of_codes.end(), section) == not_of_codes.end();
}

std::uint64_t with_text(std::string_view text, std::uint64_t seed) {
  return hash_bytes(text.data(), text.size(), hash_bytes("|", 1, seed));
}

std::uint64_t hash_of_readable(const std::filesystem::path& case_file) {
  std::uint64_t hash = 0;
  for (const YamlNode::Entry& entry : as_one_file(read_case_tree(case_file)).entries)
    if (may_be_read(entry.key)) hash = with_text(yaml_text(entry.value), with_text(entry.key, hash));
  for (const InputFile& input : input_files(case_file))
    if (may_be_read(input.field.substr(0, input.field.find('.'))))
      hash = hash_bytes(&input.content, sizeof input.content, with_text(input.field, hash));
  return hash;
}

}  // namespace

std::string untold_json(const MasterCase& master, std::span<protocol::Partner> processes) {
  const auto& programs = master.coupling.programs;
  const std::array named{programs.fluid, programs.solid};
  std::string codes;
  for (std::size_t k = 0; k < named.size(); ++k) {
    const std::string &role = processes[k].role(), &itself = processes[k].hello().program;
    if (protocol::is_own(named[k]) && itself == "Tether " + role) continue;
    codes += fmt::format(R"(, "{}": "{:x}")", role, with_text(itself, hash_content(named[k])));
  }
  if (codes.empty()) return "{}";
  return fmt::format(R"({{"codes_of_others": {{"case": "{:x}"{}}}}})", hash_of_readable(master.file.path()), codes);
}

std::string followed_json(const OutputCase& output) {
  std::uint64_t hash = 0;
  for (const auto& [name, place] : output.points) hash = hash_values(place, with_text(name, hash));
  return fmt::format(R"({{"followed": {{"points": "{:x}"}}}})", hash);
}

}  // namespace tether
