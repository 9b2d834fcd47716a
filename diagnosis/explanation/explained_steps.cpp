#include "diagnosis/explanation/explained_steps.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

#include "common/base/built_from.hpp"
#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/newest_state.hpp"
#include "common/base/progress_line.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/config/input_watch.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of this process and all that it started and that ended.
double cpu_seconds_of_all() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

constexpr const char* begun_step = "step_begun";

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// Of the case, of what its files hold, of what else was asked, and of the version, whose files others may not
/// understand.
std::string key_of(const fs::path& case_file, std::uint64_t asked) {
  std::uint64_t hash = hash_case(yaml_text(as_one_file(read_case_tree(case_file))), asked);
  for (const InputFile& input : input_files(case_file))
    hash = hash_bytes(&input.content, sizeof input.content, hash_values(input.field, hash));
  return fmt::format("{:016x} {}", hash, built_from);
}

std::string content_of(const fs::path& file) {
  return fmt::format("{:016x}", hash_content(file));
}

/// The records and tables in a step's folder, by name.
std::vector<LeftFile> left_in(const fs::path& folder) {
  std::vector<LeftFile> left;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string kind = entry.path().extension().string();
    if (!entry.is_regular_file() || (kind != ".json" && kind != ".yaml" && kind != ".csv")) continue;
    left.push_back({entry.path().filename().string(), content_of(entry.path())});
  }
  std::sort(left.begin(), left.end(), [](const LeftFile& a, const LeftFile& b) { return a.name < b.name; });
  return left;
}

}  // namespace

ExplainedSteps::ExplainedSteps(fs::path output, const InputWatch& inputs, bool quiet)
    : output_(std::move(output)), inputs_(inputs), quiet_(quiet) {
  if (!fs::exists(output_ / "steps.json")) return;
  try {
    before_ = read_record<StepsMade>(output_ / "steps.json").steps;
  } catch (const InputError&) {  // of another version: its steps are made anew
  }
}

void ExplainedSteps::make(const std::string& title, const fs::path& case_file, const std::string& folder,
                          const std::string& result, const std::function<void(bool)>& act, std::uint64_t asked) {
  const InputWatch inputs(case_file);
  inputs_.check();
  const std::string key = key_of(case_file, asked);
  if (!quiet_) std::cout << fmt::format("\n== {}\n", title) << std::flush;
  if (const StepMade* before = kept({title, folder, 0, 0, key}); before && fs::exists(output_ / folder / result)) {
    if (!quiet_) std::cout << fmt::format("is there, in {}\n", (output_ / folder).string()) << std::flush;
    done_.push_back(*before);
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds_of_all();
  const std::string mark = title + " " + key;
  const bool was_begun = first_line(output_ / begun_step) == mark;
  if (!was_begun) remove_states(output_ / folder);  // of another step that was made there
  std::ofstream(output_ / begun_step) << mark << std::endl;
  try {
    act(was_begun);
  } catch (const ToldFailure& failure) {
    if (failure.exit_code == exit_input_wrong)
      throw input_error("{}: is refused (see above){}", title,
                        was_begun ? "; with --overwrite this step begins anew" : "");
    throw run_error("{}: {}; the same command goes on from here{}", title, failure.what(),
                    was_begun ? ", with --overwrite it begins this step anew" : "");
  }
  inputs.check();
  inputs_.check();
  done_.push_back({{title, folder, seconds_since(start), cpu_seconds_of_all() - cpu, key}, left_in(output_ / folder)});
  save();
  fs::remove(output_ / begun_step);
}

const StepMade* ExplainedSteps::kept(const ExplainedStep& step) const {
  const auto found = std::find_if(before_.begin(), before_.end(), [&](const StepMade& made) {
    return made.step.name == step.name && made.step.folder == step.folder && made.step.key == step.key;
  });
  if (found == before_.end()) return nullptr;
  const fs::path folder = output_ / step.folder;
  const auto damaged = std::find_if(found->left.begin(), found->left.end(), [&](const LeftFile& file) {
    return content_of(folder / file.name) != file.content;
  });
  if (damaged == found->left.end()) return &*found;
  fmt::print(stderr, "{}: is not as its step left it: the step is made again\n", (folder / damaged->name).string());
  for (const LeftFile& file : found->left) fs::remove(folder / file.name);
  return nullptr;
}

std::vector<ExplainedStep> ExplainedSteps::all() const {
  std::vector<ExplainedStep> steps;
  for (const StepMade& made : done_) steps.push_back(made.step);
  return steps;
}

/// Steps that were made before and have not had their turn yet are still there: whoever makes one anew, or is broken
/// off, does not forget those behind it.
void ExplainedSteps::save() const {
  StepsMade all{done_};
  for (const StepMade& before : before_)
    if (std::none_of(done_.begin(), done_.end(),
                     [&](const StepMade& made) { return made.step.folder == before.step.folder; }))
      all.steps.push_back(before);
  write_record(output_ / "steps.json", all);
}

}  // namespace tether
