#pragma once

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"
#include "common/config/input_watch.hpp"
#include "identification_master/group_pool.hpp"
#include "identification_master/identification_case.hpp"
#include "observation_manager/measurements/observed_case.hpp"

namespace tether {

/// A case and what of it an identification reads.
struct IdentifiedCase {
  explicit IdentifiedCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("observations", observations);
    file.read("identification", identification);
    file.finish();
    if (identification.parameters.empty())
      throw input_error("{}: names no parameters to be found", file.where("identification.parameters"));
  }
  /// The wall's element does not matter: interface nodes are the same.
  VesselMesh vessel() const { return load_mesh(mesh, file, WallElement::prism); }
  LumenSurface lumen() const { return lumen_of(vessel()); }
  std::size_t particles() const { return identification.parameters.size() + 1; }

  CaseFile file;
  MeshCase mesh;
  ObservationsCase observations;
  IdentificationCase identification;
};

/// What was measured. Throws InputError if nothing of it may be learnt from, or the noise of what may is not stated.
Observations data_of(const IdentifiedCase& given);

/// One identification on groups of processes that are there: estimates, the identified case and checkpoints in a folder
/// that is held. Throws InputError for a checkpoint of something else, RunError if a step fails for good, after a
/// signal, or if the case's files were written since `inputs` was made.
void identify(const IdentifiedCase& given, const CommandLine& command, GroupPool& pool,
              const std::filesystem::path& output, const InputWatch& inputs);

}  // namespace tether
