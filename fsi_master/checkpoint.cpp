#include "fsi_master/checkpoint.hpp"

#include <algorithm>
#include <array>

#include "common/base/checked_file.hpp"
#include "common/base/newest_state.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/protocol/packet.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::Bytes;

template <class... Fields>
Bytes packed(const Fields&... fields) {
  protocol::Writer writer;
  writer(fields...);
  return writer.take();
}

/// A file and the fields in it.
template <class... Fields>
CheckedContent unpack(const fs::path& path, Fields&... fields) {
  CheckedContent content = read_checked(path);
  try {
    protocol::Reader reader("checkpoint", content.bytes);
    reader(fields...);
    reader.expect_end();
  } catch (const protocol::MalformedMessage& error) {
    throw input_error("{}: {}", path.string(), error.what());
  }
  return content;
}

Checkpoint read_folder(const fs::path& folder) {
  Checkpoint c;
  std::vector<double> numbers;
  std::int64_t states = 0;
  const CheckedContent master = unpack(folder / "master.bin", c.snapshot.displacement, c.snapshot.velocity,
                                       c.snapshot.method, c.snapshot.coupling, numbers, c.without_state, c.coupling,
                                       c.origin, c.table, c.motion, c.velocity, states);
  c.step = master.step;
  c.fingerprint = master.fingerprint;
  auto next = numbers.begin();
  c.statistics.numbers([&](double& value) { value = next != numbers.end() ? *next++ : 0.0; });
  for (const auto& [name, state] :
       {std::pair("fluid.bin", &c.snapshot.fluid), std::pair("solid.bin", &c.snapshot.solid)}) {
    const CheckedContent content = unpack(folder / name, *state);
    if (content.step != c.step) throw input_error("{}: is of another step than master.bin", (folder / name).string());
  }
  if (static_cast<std::uint64_t>(states) != hash_of_states(packed(c.snapshot.fluid), packed(c.snapshot.solid)))
    throw input_error("{}: holds states of different runs: fluid.bin and solid.bin are not those of its master.bin",
                      folder.string());
  return c;
}

constexpr const char *newest = newest_checkpoint, *before = earlier_checkpoint;
constexpr const char* fresh = fresh_checkpoint;  ///< whole if the run was killed before it put it in its place
constexpr const auto& files = run_state_files;

/// Whether a run has saved one there, and not an identification alone.
bool holds_state(const fs::path& folder) {
  return std::any_of(files.begin(), files.end(), [&](const char* file) { return fs::exists(folder / file); });
}

/// The newest that is whole.
Checkpoint newest_in(const fs::path& output) {
  std::string damage;
  for (const fs::path& folder : {newest_state(output), output / newest, output / before}) {
    if (!fs::exists(folder)) continue;
    try {
      Checkpoint checkpoint = read_folder(folder);
      checkpoint.refused = damage;
      return checkpoint;
    } catch (const InputError& error) {
      if (damage.empty()) damage = error.what();
    }
  }
  if (damage.empty() || !(holds_state(output / newest) || holds_state(output / before)))
    throw input_error("{}: holds no checkpoint of a run", output.string());
  throw input_error("{}; there is none before it", damage);
}

void check_has_states(const Checkpoint& checkpoint, const fs::path& output) {
  if (!checkpoint.without_state.empty())
    throw input_error("{}: cannot be continued: {} announced no state to be saved", output.string(),
                      checkpoint.without_state);
}

/// What others than runs have there: an identification, whose job may be in the same folder, or a person.
std::vector<fs::path> others_in(const fs::path& folder) {
  std::vector<fs::path> others;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (std::find(files.begin(), files.end(), entry.path().filename()) == files.end()) others.push_back(entry.path());
  return others;
}

bool is_of_identification(const fs::path& name) {
  return std::find(identification_state_files.begin(), identification_state_files.end(), name) !=
         identification_state_files.end();
}

/// What is not in the other folder yet; of a name that is there, unless it is the same file or an identification's
/// state of before, under another (NAME.previous).
void move_others(const fs::path& from, const fs::path& to) {
  std::error_code none;
  for (const fs::path& other : others_in(from)) {
    fs::path place = to / other.filename();
    if (fs::equivalent(other, place, none)) continue;
    if (fs::exists(fs::symlink_status(place)) && is_of_identification(other.filename())) continue;
    while (fs::exists(fs::symlink_status(place))) place += ".previous";
    put_in_place(other, place);
  }
}

/// Files, and not folders, stand in both until these have changed places: a run may be killed at each moment.
void lend_others(const fs::path& from, const fs::path& to) {
  for (const fs::path& other : others_in(from)) {
    const fs::path lent = to / other.filename();
    if (fs::is_directory(fs::symlink_status(other))) {
      if (!fs::exists(lent)) put_in_place(other, lent);
      continue;
    }
    std::error_code error;
    fs::remove(lent);
    fs::create_hard_link(other, lent, error);
    if (error && !fs::copy_file(other, lent, error)) throw write_error(lent);
  }
}

void put_fresh_in_place(const fs::path& output) {
  lend_others(output / newest, output / fresh);
  move_others(output / before, output / fresh);
  fs::remove_all(output / before);
  if (fs::exists(output / newest)) put_in_place(output / newest, output / before);
  put_in_place(output / fresh, output / newest);
  for (const fs::path& other : others_in(output / before)) fs::remove(other);
}

}  // namespace

void remove_checkpoints(const fs::path& output) {
  for (const char* folder : {fresh, newest, before})
    for (const char* file : files) fs::remove(output / folder / file);
  for (const char* folder : {fresh, before}) {
    const bool is_all_there_is = !fs::exists(output / newest) && !others_in(output / folder).empty();
    if (is_all_there_is) put_in_place(output / folder, output / newest);  // killed as they changed places
    move_others(output / folder, output / newest);
    fs::remove_all(output / folder);
  }
  if (others_in(output / newest).empty()) fs::remove_all(output / newest);
}

void write_checkpoint(const fs::path& output, const Checkpoint& checkpoint) {
  const fs::path next = output / fresh;
  std::vector<double> numbers;
  RunStatistics statistics = checkpoint.statistics;
  statistics.numbers([&](double& value) { numbers.push_back(value); });
  const Snapshot& s = checkpoint.snapshot;
  if (is_whole_state(next)) put_fresh_in_place(output);  // it may be the only one that is
  fs::remove_all(next);
  make_folder(next);
  const auto write = [&](const char* name, const Bytes& bytes) {
    write_checked(next / name, checkpoint.fingerprint, checkpoint.step, bytes);
  };
  const Bytes fluid = packed(s.fluid), solid = packed(s.solid);
  write("master.bin", packed(s.displacement, s.velocity, s.method, s.coupling, numbers, checkpoint.without_state,
                             checkpoint.coupling, checkpoint.origin, checkpoint.table, checkpoint.motion,
                             checkpoint.velocity, static_cast<std::int64_t>(hash_of_states(fluid, solid))));
  write("fluid.bin", fluid);
  write("solid.bin", solid);
  flush_to_disk(next);
  put_fresh_in_place(output);
  flush_to_disk(output);
}

Checkpoint read_checkpoint(const fs::path& output) {
  Checkpoint checkpoint = newest_in(output);
  if (!checkpoint.refused.empty())
    throw input_error("{}; the state before it, of step {}, is whole: let that run go on from it (--resume) first",
                      checkpoint.refused, checkpoint.step);
  check_has_states(checkpoint, output);
  return checkpoint;
}

Checkpoint read_checkpoint(const fs::path& output, std::uint64_t fingerprint, const std::string& changes) {
  Checkpoint checkpoint;
  try {
    checkpoint = newest_in(output);
  } catch (const InputError& error) {
    throw input_error("{}: start anew without --resume", error.what());
  }
  if (checkpoint.fingerprint != fingerprint)
    throw input_error(
        "{}: is a checkpoint of another case, step, mesh or code{}; give the case as it was, or start anew without "
        "--resume, or let the case begin with that state (initial_state)",
        (output / "checkpoint").string(), changes.empty() ? "" : " (" + changes + ")");
  check_has_states(checkpoint, output);
  return checkpoint;
}

std::optional<Checkpoint> checkpoint_before(const fs::path& output, const Checkpoint& later) {
  for (const char* name : {newest, before}) try {
      Checkpoint earlier = read_folder(output / name);
      if (earlier.step < later.step && earlier.fingerprint == later.fingerprint) return earlier;
    } catch (const InputError&) {
    }
  return std::nullopt;
}

}  // namespace tether
