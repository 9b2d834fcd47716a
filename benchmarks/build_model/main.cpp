#include <chrono>
#include <iostream>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/vessel/anatomies/remesh.hpp"
#include "vessel/anatomy/centreline_file.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/model/vessel_model.hpp"

/// build_model_benchmark SURFACE.vtp SCALE CENTRELINE.csv EDGE THICKNESS BRANCH_THICKNESS OUTPUT NAME...: the volume
/// side of a study by itself, on a closed surface whose ModelFaceID k is the opening with the k-th name, the inlet
/// first. Lengths in cm; EDGE 0: the triangles stay as they are.
int main(int argc, char** argv) try {
  using namespace tether;
  if (argc < 9) return 2;
  const MeshFile file = read_mesh_file(argv[1]);
  LabelledSurface surface{file.points * std::stod(argv[2]), file.triangles, {}, {argv + 8, argv + argc}, 0};
  for (const auto label : file.triangle_labels.at("ModelFaceID")) surface.label.push_back(static_cast<int>(label));
  const CentrelineTree tree = read_centreline(argv[3], UnitSystem::cgs());
  VolumeCase study;
  study.wall.thickness.thickness = std::stod(argv[5]);
  study.wall.least_share = 0.3;
  for (std::size_t i = 1; i < tree.branches.size(); ++i) {
    study.wall.branches.emplace_back(tree.branches[i].name, ThicknessCase{});
    study.wall.branches.back().second.thickness = std::stod(argv[6]);
  }
  GeometricRegionCase trunk;
  trunk.branches = {tree.branches[0].name};
  trunk.divide = 5;
  study.regions = {{tree.branches[0].name, trunk}, {"branches", {}}};
  if (const double edge = std::stod(argv[4]); edge > 0) surface = remeshed(surface, edge);
  const auto begin = std::chrono::steady_clock::now();
  const VesselModel model = build_model(surface, tree, study, UnitSystem::cgs());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  write_model(argv[7], "model", model, tree, study, UnitSystem::cgs());
  std::cout << json_of(model.quality) << "\n" << taken.count() << " s\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
