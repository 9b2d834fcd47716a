#pragma once

#include <filesystem>

#include "identification_master/identification.hpp"

namespace tether {

/// What the steps so far have cost, in all runs that made them.
struct IdentificationCost {
  double wall_seconds = 0, cpu_seconds = 0, master_cpu_seconds = 0;  ///< of the steps: all groups, the master
  int moved_values = 0;                                              ///< into their range
};

struct IdentificationCheckpoint {
  IdentificationState state;
  IdentificationCost cost;
};

/// OUTPUT/checkpoint/identification.bin: written beside the old one, flushed, renamed. Throws RunError if the disk
/// refuses.
void write_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint, const IdentificationState& state,
                      const IdentificationCost& cost);

/// Throws InputError: none, damaged, of another case.
IdentificationCheckpoint read_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint);

}  // namespace tether
