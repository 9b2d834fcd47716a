#pragma once

#include <filesystem>
#include <functional>

#include "identification_master/identification.hpp"

namespace tether {

/// What the steps so far have cost, in all runs that made them.
struct IdentificationCost {
  double wall_seconds = 0, cpu_seconds = 0, master_cpu_seconds = 0;  ///< of the steps: all groups, the master
  int moved_values = 0;                                              ///< into their range
};

struct IdentificationCheckpoint {
  IdentificationState state;
  std::vector<std::vector<double>> at_hand;  ///< of each group (GroupPool)
  IdentificationCost cost;
  std::uint64_t table = 0;   ///< checksum of estimate.csv so far
  std::string refused = {};  ///< why a newer one is not taken: it, or what it counts on, is damaged
};

/// OUTPUT/checkpoint/identification.bin: written beside the old one, flushed, renamed; the one before stays as
/// identification.previous. Throws RunError if the disk refuses.
void write_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint,
                      const IdentificationCheckpoint& checkpoint);

/// All that an earlier identification saved: the next checkpoint would take what is left for the one before it.
void remove_identification_checkpoints(const std::filesystem::path& output);

/// On how many groups the steps before the newest whole one were made: what solves have taught each group is not the
/// same on others, so that results differ within the coupling's tolerance. Throws InputError: none, both damaged.
std::size_t groups_of_checkpoint(const std::filesystem::path& output);

/// The newest whole one whose step finds what it counts on beside it: `take_up` goes on there, or throws InputError.
/// Throws InputError: none, both damaged, of another case. changes: what makes it another, as far as that is known.
IdentificationCheckpoint read_identification_checkpoint(
    const std::filesystem::path& output, std::uint64_t fingerprint, const std::string& changes,
    const std::function<void(const IdentificationCheckpoint&)>& take_up);

}  // namespace tether
