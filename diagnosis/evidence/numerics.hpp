#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/evidence/diagnosed_case.hpp"

namespace tether {

/// The model with a finer mesh or a shorter step: how much of the misfit is numerical.
struct RefinedCase {
  std::string name;     ///< of the candidate: coarse_mesh or long_step
  std::string meaning;  ///< of its amplitude
  std::filesystem::path file;
};

/// Its run, as the nodes of the model's own lumen move in it.
struct RefinedRun {
  RefinedCase refined;
  FinishedMotion motion;
};

/// Writes cases beside that of all candidates: half the step; of a swept mesh twice the elements around and along.
std::vector<RefinedCase> write_refined(const std::filesystem::path& candidates, const DiagnosedCase& given);

/// The lumen in the mesh of a case.
LumenSurface lumen_in(const std::filesystem::path& case_file);

/// Adds what refining changes as a candidate: amplitude 0 as the model is, 1 as the refined one.
void add_numerics(EffectProblem& problem, const RefinedCase& refined, const VectorXd& change);

/// Allows what step and mesh of the model may be wrong by: of the difference that twice of both make, a third where
/// they converge with second order, all of it with first order. coarse: residual of the coarser model as it is [n].
/// (D.8)
void allow_numerics(EffectProblem& problem, const VectorXd& coarse);

}  // namespace tether
