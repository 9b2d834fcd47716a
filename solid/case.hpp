#pragma once

#include <memory>

#include "common/config/case_file.hpp"
#include "solid/effects_case.hpp"
#include "solid/motion_case.hpp"
#include "solid/results/rest_state.hpp"
#include "solid/wall_model.hpp"

namespace tether {

/// How a region of the outer wall is held.
struct SupportCase {
  EffectCase effect{"visco_elastic", {}};
  void declare(Fields& f);
};

/// How an end ring is held: clamped, driven along a measured motion, free, or by a support, which may follow one.
struct RingCase {
  EffectCase effect{"clamped", {}};
  std::optional<MotionCase> motion;
  void declare(Fields& f);
};

struct SupportsCase {
  std::string area = "reference";
  Named<SupportCase> regions;
  void declare(Fields& f);
};

/// The section `solid` of a case file.
struct SolidCase {
  double density = undefined, viscosity = 0.0, theta = 0.5;
  std::string element = "prism", integrator = "midpoint";
  EffectCase material;
  SupportsCase support;
  Named<RingCase> rings;
  Named<WallEffectCase> effects;
  void declare(Fields& f);
};

/// Throws InputError for a region or ring that the mesh does not have.
void check_against_mesh(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file);
/// Reads the tables of what moves rings and tissue. Throws InputError for one that is wrong.
void check_motions(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file);

/// A wall ready to move, and what a person should know of it.
struct PreparedWall {
  std::unique_ptr<WallModel> model;
  RestState rest;          ///< how it begins
  VectorXd observer_gain;  ///< of each interface node [1/time]; empty: no state observer
  std::vector<std::string> notices;
};

/// The wall of a case. Rings that the case does not name are clamped. Throws InputError for names that the mesh does
/// not have, RunError if no stress-free configuration is found.
PreparedWall prepare_wall(const SolidCase& solid, WallMesh mesh, const CaseFile& file, Team& team = alone());

}  // namespace tether
