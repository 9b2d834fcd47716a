#include "report/provenance.hpp"

#include <fmt/chrono.h>
#include <sys/stat.h>

#include <chrono>

#include "common/base/built_from.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::system_clock;

std::string date(Clock::time_point moment) {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(Clock::to_time_t(moment)));
}

void gather(const YamlNode& node, const std::string& field, const fs::path& folder, CaseInputs& inputs) {
  std::error_code none;
  if (node.kind == YamlNode::Kind::scalar) {
    const fs::path file = folder / node.text;
    if (field.ends_with(".seed")) inputs.seeds.push_back({field, node.text});
    if (!node.text.empty() && fs::is_regular_file(file, none))
      inputs.files.push_back({field, node.text, date_of(file), fs::file_size(file, none),
                              fmt::format("{:016x}", hash_content(file)), file});
  }
  for (const YamlNode& item : node.items) gather(item, field, folder, inputs);
  for (const YamlNode::Entry& entry : node.entries)
    gather(entry.value, field.empty() ? entry.key : field + "." + entry.key, folder, inputs);
}

}  // namespace

CaseInputs inputs_of(const fs::path& case_file) {
  CaseInputs inputs;
  gather(as_one_file(read_case_tree(case_file)), "", case_file.parent_path(), inputs);
  return inputs;
}

std::string date_of(const fs::path& file) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  if (error) return {};
  return date(std::chrono::time_point_cast<Clock::duration>(std::chrono::file_clock::to_sys(written)));
}

bool came_after(const fs::path& file, const fs::path& result) {
  struct stat of_file {
  }, of_result{};
  if (stat(file.c_str(), &of_file) != 0 || stat(result.c_str(), &of_result) != 0) return false;
  const timespec &came = of_file.st_ctim, &made = of_result.st_mtim;
  return std::pair(came.tv_sec, came.tv_nsec) > std::pair(made.tv_sec, made.tv_nsec);
}

std::string date_now() {
  return date(Clock::now());
}

std::optional<fs::path> case_of_results(const fs::path& folder) {
  std::optional<fs::path> file = owner_of(folder);
  if (file && !fs::is_regular_file(*file)) return std::nullopt;
  return file;
}

std::string version() {
  return TETHER_VERSION;
}

std::string commit() {
  return built_from;
}

}  // namespace tether
