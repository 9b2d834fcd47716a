#pragma once

#include <string>

#include "common/config/case_file.hpp"
#include "fsi_master/checkpoint.hpp"

namespace tether {

/// The section `initial_state` of a case.
struct InitialStateCase {
  std::filesystem::path from;
  void declare(Fields& f);
};

/// What a run begins with instead of the vessel at rest: the last state that another run saved.
struct InitialState {
  Snapshot snapshot;
  std::string where;   ///< the case says so
  std::string notice;  ///< for a person: what begins anew

  /// Throws InputError if a code does not take it.
  void put(TimeLoop& loop) const;
};

/// What of a case its states are made of. model: fingerprint of all that its codes are told.
StateOrigin origin_of(const CaseFile& file, const Points& interface, std::uint64_t model);

/// What the coupling remembers is taken from a run of the same model only: it is for
/// speed. Throws InputError: no state there; of another mesh, in other units, relative to another pressure.
InitialState initial_state_of(const InitialStateCase& given, const CaseFile& file, const StateOrigin& own);

/// What can be said without a mesh. Throws InputError.
void check_initial_state(const InitialStateCase& given, const CaseFile& file);

}  // namespace tether
