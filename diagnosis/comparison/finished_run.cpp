#include "diagnosis/comparison/finished_run.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/io/record_file.hpp"
#include "fsi_master/results/run_summary.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Sections that do not change what a run computes; measurements do if an observer pulls the wall toward them.
constexpr std::array without_effect{"title", "twin", "observations", "identification", "diagnosis", "output"};

bool has_effect(const std::string& section, const YamlNode& tree) {
  if (section == "observations" && tree.find("observer") != nullptr) return true;
  return std::find(without_effect.begin(), without_effect.end(), section) == without_effect.end();
}

bool same(const YamlNode& a, const YamlNode& b);

bool same_entries(const YamlNode& a, const YamlNode& b) {
  return std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                    [](const auto& x, const auto& y) { return x.key == y.key && same(x.value, y.value); });
}

bool same(const YamlNode& a, const YamlNode& b) {
  return a.kind == b.kind && a.text == b.text && same_entries(a, b) &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
}

/// The first section that one case says otherwise than the other; empty if none matters.
std::string first_difference(const YamlNode& one, const YamlNode& other) {
  for (const auto* tree : {&one, &other})
    for (const auto& entry : tree->entries) {
      const YamlNode *a = one.find(entry.key), *b = other.find(entry.key);
      if (has_effect(entry.key, *tree) && (a == nullptr || b == nullptr || !same(*a, *b))) return entry.key;
    }
  return {};
}

const YamlNode* points_of(const YamlNode& tree) {
  const YamlNode* output = tree.find("output");
  return output == nullptr ? nullptr : output->find("points");
}

/// The first point that is followed and was not, or elsewhere; empty if there is none.
std::string first_other_point(const YamlNode& now, const YamlNode& then) {
  const YamlNode *asked = points_of(now), *followed = points_of(then);
  if (asked == nullptr) return {};
  for (const auto& entry : asked->entries) {
    const YamlNode* before = followed == nullptr ? nullptr : followed->find(entry.key);
    if (before == nullptr || !same(entry.value, *before)) return entry.key;
  }
  return {};
}

std::string section_of(const InputFile& input) {
  return input.field.substr(0, input.field.find('.'));
}

/// The first file of the case that holds something else than when the run started; empty if there is none.
std::string first_changed_file(const std::vector<InputFile>& now, const std::vector<ReadFile>& then,
                               const YamlNode& tree) {
  for (const InputFile& input : now) {
    if (!has_effect(section_of(input), tree)) continue;
    const std::string content = fmt::format("{:016x}", input.content);
    const bool same = std::any_of(then.begin(), then.end(), [&](const ReadFile& before) {
      return before.field == input.field && before.name == input.name && before.content == content;
    });
    if (!same) return input.name;
  }
  return {};
}

RunSummary summary_in(const fs::path& output) {
  return read_record<RunSummary>(output / "summary.json");
}

void check_is_as_written(const fs::path& output, const std::map<std::string, std::string>& written) {
  const auto now = hashes_of_results(output);
  for (const auto& [name, content] : now)
    if (const auto then = written.find(name); then == written.end() || then->second != content)
      throw input_error("{}: was changed after the run: it is not what the run wrote", (output / name).string());
  for (const auto& [name, content] : written)
    if (now.count(name) == 0) throw input_error("{}: was removed after the run", (output / name).string());
}

}  // namespace

std::optional<std::string> why_not_run(const fs::path& output, const CaseFile& file, int steps) {
  for (const char* name : {"summary.json", "lumen.motion", "timeseries.csv"})
    if (!fs::exists(output / name)) return fmt::format("{} holds no finished run", output.string());
  const RunSummary summary = summary_in(output);
  const YamlNode now = as_one_file(read_case_tree(file.path())), then = yaml_value(summary.made_from.case_text);
  if (const std::string section = first_difference(now, then); !section.empty())
    return fmt::format("the run in {} had another '{}'", output.string(), section);
  if (const std::string point = first_other_point(now, then); !point.empty())
    return fmt::format("the run in {} did not follow the point '{}' of output.points, or elsewhere", output.string(),
                       point);
  if (summary.made_from.coupled_otherwise)
    return fmt::format("the run in {} was continued with another 'coupling'", output.string());
  if (const std::string changed = first_changed_file(input_files(file.path()), summary.made_from.files, now);
      !changed.empty())
    return fmt::format("{} is not as it was for the run in {}", changed, output.string());
  if (summary.steps < steps)
    return fmt::format("the run in {} ended after {} of {} steps", output.string(), summary.steps, steps);
  return std::nullopt;
}

std::optional<std::string> why_no_velocity(const fs::path& output, const Points& points) {
  if (points.cols() == 0) return std::nullopt;
  const fs::path file = output / "blood.velocity";
  if (fs::exists(file) && BloodVelocity(file).points() == points) return std::nullopt;
  return fmt::format("the run in {} did not record the velocity at the points of these measurements", output.string());
}

FinishedRun::FinishedRun(const fs::path& output) : motion(output / "lumen.motion") {
  if (fs::exists(output / "blood.velocity")) velocity.emplace(output / "blood.velocity");
  const RunSummary summary = summary_in(output);
  steps = static_cast<int>(summary.steps);
  motion.check_has(steps);
  if (velocity) velocity->check_has(steps);
  check_has_rows(output / "timeseries.csv", steps);
  check_is_as_written(output, summary.written);
  if (summary.observer) observer_gain = summary.observer->gain;
}

std::optional<std::string> damage_of(const fs::path& output) {
  try {
    const FinishedRun whole(output);
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

RunMotion motion_of(const FinishedRun& run, const LumenSurface& lumen) {
  const Points &ours = lumen.points, &its = run.motion.imaged();
  const double size = (ours.rowwise().maxCoeff() - ours.rowwise().minCoeff()).norm();
  if (ours.cols() != its.cols() || (ours - its).cwiseAbs().maxCoeff() > 1e-6 * size)
    throw input_error("lumen.motion: its {} nodes are not the {} of the case's mesh", its.cols(), ours.cols());
  return {run.motion.times().front(), run.motion.times().back(), its,
          [&run](double time) { return run.motion.at(time); }};
}

}  // namespace tether
