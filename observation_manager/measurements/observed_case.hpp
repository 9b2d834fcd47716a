#pragma once

#include "common/config/case_file.hpp"
#include "observation_manager/measurements/observations.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {

/// A case file and the sections of it that observation needs. Throws InputError.
struct ObservedCase {
  explicit ObservedCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("observations", observations);
    file.finish();
  }
  /// The wall's element does not matter: interface nodes are the same.
  VesselMesh vessel() const { return load_mesh(mesh, file, WallElement::prism); }
  LumenSurface lumen() const { return lumen_of(vessel()); }

  CaseFile file;
  MeshCase mesh;
  ObservationsCase observations;
};

}  // namespace tether
