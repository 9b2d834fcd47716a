#include <algorithm>
#include <array>
#include <sstream>

#include "common/base/error.hpp"
#include "common/config/describe.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/evidence/diagnosis_case.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

constexpr std::array readers{"fluid", "solid", "fsi_master", "observation_manager", "identification_master"};

/// Parts of a reference that stand or fall together: a field with its meaning, or a whole section's table.
std::vector<std::string> blocks(const std::string& text, const std::string& format) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool begins = format != "text" ? line.starts_with("## ") : !line.starts_with(" ");
    if (begins || found.empty()) found.emplace_back();
    found.back() += line + "\n";
  }
  return found;
}

/// The section `diagnosis`, which no other program reads.
std::string describe_diagnosis(const std::string& format) {
  Describe describe(UnitSystem::cgs());
  DiagnosisCase diagnosis;
  describe.group("diagnosis", diagnosis, meaning_of_section("diagnosis"));
  return format == "markdown" ? describe.markdown() : describe.text();
}

}  // namespace

std::string case_reference(const std::string& format) {
  std::vector<std::string> all;
  for (const char* reader : readers) {
    const ChildEnd end = capture({{sibling(reader).string(), "--describe-config", format}, {}});
    if (end.exit_code != exit_done) throw run_error("{} --describe-config failed: {}", reader, end.errors);
    for (auto& block : blocks(end.output, format))
      if (std::find(all.begin(), all.end(), block) == all.end()) all.push_back(std::move(block));
  }
  if (format != "effects")
    all.insert(all.end(), {describe_diagnosis(format), describe_twin(format)});  // they offer none
  std::string text;
  for (const auto& block : all) text += block;
  return text;
}

}  // namespace tether
