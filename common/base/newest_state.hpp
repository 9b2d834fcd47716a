#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

/// Which of the folders that runs save their states in counts: for those who read it, and those who ask whether it is
/// another than before.
namespace tether {

/// Of a run's states, in its output: the newest; one that was not put in its place yet; the one before.
inline constexpr const char *newest_checkpoint = "checkpoint", *fresh_checkpoint = "checkpoint.new",
                            *earlier_checkpoint = "checkpoint.previous";

/// In these folders: of a run, and of an identification (the newest, one not put in its place yet, the one before).
inline constexpr std::array run_state_files{"master.bin", "fluid.bin", "solid.bin"},
    identification_state_files{"identification.bin", "identification.new", "identification.previous"};

/// Which states belong together: those of another run may be of the same step. master.bin ends with it.
std::uint64_t hash_of_states(std::span<const std::byte> fluid, std::span<const std::byte> solid);

/// Whether such a folder has master.bin, fluid.bin and solid.bin, undamaged and of one run and step.
bool is_whole_state(const std::filesystem::path& folder);

/// checkpoint.new if it is whole, as a run leaves it that is killed just before it puts it in its place; else
/// checkpoint, whatever that is like.
std::filesystem::path newest_state(const std::filesystem::path& output);

enum class StateOf { run, identification };
/// Whether there is one to go on from: the newest, the one before, or one that was not put in its place yet, if that is
/// whole.
bool has_state(const std::filesystem::path& output, StateOf what);

/// Takes away what runs and identifications saved in these folders; what else is in them stays.
void remove_states(const std::filesystem::path& output);

}  // namespace tether
