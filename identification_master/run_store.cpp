#include "identification_master/run_store.hpp"

#include <fmt/format.h>

#include <system_error>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

fs::path record_in(const fs::path& folder) {
  return folder / "run.json";
}

/// Moves a folder, as a whole, to where nothing is; onto another disk by a copy beside the place.
void move_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error != std::errc::cross_device_link) return;
  const fs::path copy = to.string() + "." + holder_name();
  fs::copy(from, copy, fs::copy_options::recursive, error);
  if (!error) fs::rename(copy, to, error);
  if (error) fs::remove_all(copy, error);
}

}  // namespace

std::optional<MadeRun> made_run_in(const fs::path& folder) {
  if (!fs::exists(record_in(folder))) return std::nullopt;
  try {
    MadeRun run = read_record<MadeRun>(record_in(folder));
    if (run.written != hashes_of_results(folder)) return std::nullopt;
    if (!run.failure) check_is_whole(folder, run.steps);
    return run;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void write_made_run(const fs::path& folder, MadeRun run) {
  run.written = hashes_of_results(folder);
  write_record(record_in(folder), run);
}

RunStore::RunStore(fs::path folder, std::string depends_on)
    : folder_(std::move(folder)), depends_on_(std::move(depends_on)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw input_error("{}: the folder of shared runs cannot be made: {}", folder_.string(), error.message());
  folder_ = fs::canonical(folder_);
}

std::optional<MadeRun> RunStore::lend(const MadeRun& wanted, const fs::path& folder) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path place = place_of(wanted);
  std::optional<MadeRun> kept = made_run_in(place);
  if (!kept || kept->failure || !is_same_run(*kept, wanted)) return std::nullopt;
  fs::remove_all(folder);  // of a link the link alone
  fs::create_directories(folder.parent_path());
  fs::create_directory_symlink(place, folder);
  return kept;
}

void RunStore::take(const MadeRun& made, const fs::path& folder) const {
  if (folder_.empty() || fs::is_symlink(folder)) return;
  const fs::path place = place_of(made);
  fs::create_directories(place.parent_path());
  const std::optional<MadeRun> kept = made_run_in(place);
  if (!kept || kept->failure) fs::remove_all(place);  // of another version, damaged, or without an end
  move_folder(folder, place);
  lend(made, folder);
}

/// CASE/RUN in hexadecimal digits: all runs of a model are in one folder.
fs::path RunStore::place_of(const MadeRun& run) const {
  std::string text = fmt::format("{}|{}|{}", depends_on_, run.case_hash, run.steps);
  for (const auto& [name, value] : run.values) text += fmt::format("|{}={}", name, value);
  return folder_ / run.case_hash / fmt::format("{:016x}", hash_bytes(text.data(), text.size()));
}

}  // namespace tether
