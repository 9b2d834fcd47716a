#include "common/base/newest_state.hpp"

#include <cstring>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"

namespace tether {

namespace {

bool is_whole(const std::filesystem::path& file) {
  try {
    read_checked(file);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::uint64_t hash_of_states(std::span<const std::byte> fluid, std::span<const std::byte> solid) {
  return hash_bytes(solid.data(), solid.size(), hash_bytes(fluid.data(), fluid.size(), fluid.size()));
}

bool is_whole_state(const std::filesystem::path& folder) {
  try {
    const CheckedContent master = read_checked(folder / "master.bin"), fluid = read_checked(folder / "fluid.bin"),
                         solid = read_checked(folder / "solid.bin");
    std::uint64_t states = 0;
    if (master.bytes.size() < sizeof states || fluid.step != master.step || solid.step != master.step) return false;
    std::memcpy(&states, master.bytes.data() + master.bytes.size() - sizeof states, sizeof states);
    return states == hash_of_states(fluid.bytes, solid.bytes);
  } catch (const InputError&) {
    return false;
  }
}

std::filesystem::path newest_state(const std::filesystem::path& output) {
  return output / (is_whole_state(output / fresh_checkpoint) ? fresh_checkpoint : newest_checkpoint);
}

bool has_state(const std::filesystem::path& output, StateOf what) {
  if (what == StateOf::run) {
    const auto has_master = [&](const char* folder) {
      return std::filesystem::exists(output / folder / run_state_files.front());
    };
    return has_master(newest_checkpoint) || has_master(earlier_checkpoint) || is_whole_state(output / fresh_checkpoint);
  }
  const auto& [newest, fresh, before] = identification_state_files;
  const std::filesystem::path folder = output / newest_checkpoint;
  return std::filesystem::exists(folder / newest) || std::filesystem::exists(folder / before) ||
         is_whole(folder / fresh);
}

void remove_states(const std::filesystem::path& output) {
  for (const char* name : {fresh_checkpoint, newest_checkpoint, earlier_checkpoint}) {
    const std::filesystem::path folder = output / name;
    for (const auto& files : {run_state_files, identification_state_files})
      for (const char* file : files) std::filesystem::remove(folder / file);
    if (std::filesystem::is_directory(folder) && std::filesystem::is_empty(folder)) std::filesystem::remove(folder);
  }
}

}  // namespace tether
