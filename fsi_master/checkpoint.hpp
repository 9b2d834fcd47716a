#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "fsi_master/statistics.hpp"
#include "fsi_master/time_loop.hpp"

namespace tether {

/// What another run must have in common with this one to begin with its state, and what it asks of it.
struct StateOrigin {
  std::string units;          ///< their system
  double image_pressure = 0;  ///< to which its pressures are relative
  double time = 0;            ///< of the state
  std::int64_t nodes = 0;     ///< of the interface,
  std::int64_t places = 0;    ///< and where they are in the image: a hash
  std::int64_t model = 0;     ///< a hash of all that the codes are told

  void fields(auto& archive) { archive(units, image_pressure, time, nodes, places, model); }
  void fields(auto& archive) const { archive(units, image_pressure, time, nodes, places, model); }
};

/// All that a run needs to go on from the end of a step as if it had never stopped.
struct Checkpoint {
  std::int64_t step = 0;          ///< steps done; also the rows of timeseries.csv
  std::uint64_t fingerprint = 0;  ///< of the case and the interface
  Snapshot snapshot;
  RunStatistics statistics;
  std::string without_state;  ///< programs that announce no state: such a checkpoint cannot be continued
  std::string coupling;       ///< how its steps were coupled: the section of the case, JSON
  StateOrigin origin{};
  std::int64_t table = 0;     ///< checksum of timeseries.csv,
  std::int64_t motion = 0;    ///< of lumen.motion
  std::int64_t velocity = 0;  ///< and of blood.velocity, as far as they belong to it
  std::string refused{};      ///< why a newer one is not taken: it is damaged
};

/// Writes the folder OUTPUT/checkpoint (master.bin, fluid.bin, solid.bin) as a whole: a new folder is filled, flushed
/// to the disk and renamed; the one before stays as checkpoint.previous. At each moment a whole one is there. What an
/// identification has saved there moves with it. Throws RunError if the disk refuses.
void write_checkpoint(const std::filesystem::path& output, const Checkpoint& checkpoint);

/// All that runs have saved there; what an identification has saved stays.
void remove_checkpoints(const std::filesystem::path& output);

/// The newest whole checkpoint in OUTPUT, or the one before if that is damaged. Throws InputError: none, both damaged,
/// of another case, step or mesh (fingerprint), or without a code's state. changes: what makes it another, as far as
/// that is known.
Checkpoint read_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint,
                           const std::string& changes = {});
/// The newest before that one, of the same case and whole; nothing if there is none.
std::optional<Checkpoint> checkpoint_before(const std::filesystem::path& output, const Checkpoint& later);
/// The newest of any case. Throws InputError also if it is damaged.
Checkpoint read_checkpoint(const std::filesystem::path& output);

/// Names a case and its mesh: the codes' effective cases (JSON) and the interface. What may change between a run and
/// its continuation does not count: folders of files, the end of the run, output, coupling.
std::uint64_t fingerprint(const std::vector<std::string>& effective_cases, double dt, const Points& interface);

}  // namespace tether
