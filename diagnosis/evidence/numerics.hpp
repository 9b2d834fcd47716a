#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/model_runs.hpp"

namespace tether {

/// The model with a finer mesh or a shorter step: how much of the misfit is numerical.
struct RefinedCase {
  std::string name;     ///< of the candidate: coarse_mesh or long_step
  std::string meaning;  ///< of its amplitude
  std::filesystem::path file;
  bool changes_mesh = false;
};

/// Its run, as the nodes of the model's own lumen move in it.
struct RefinedRun {
  RefinedCase refined;
  FinishedMotion motion;
  ModelRuns* runs = nullptr;   ///< what made it
  bool tells_effects = false;  ///< more of these runs tell what the mesh changes in what effects do
};

/// The name of a case of this kind beside that of all candidates: candidates_2.yaml makes coarse_2.
std::string beside_candidates(const std::filesystem::path& candidates, const std::string& kind);

/// Writes cases beside that of all candidates: half the step; of a swept mesh twice the elements around and along.
std::vector<RefinedCase> write_refined(const std::filesystem::path& candidates, const DiagnosedCase& given);

/// The lumen in the mesh of a case.
LumenSurface lumen_in(const std::filesystem::path& case_file);

/// Adds what refining changes as a candidate: amplitude 0 as the model is, 1 as the refined one.
void add_numerics(EffectProblem& problem, const RefinedCase& refined, const VectorXd& change);

/// Of what two models differ by, one of them so many times as coarse as the other, the deviation of what the finer one
/// is wrong by still: between second order, `1/(r^2 - 1)`, and first, `1/(r - 1)`. (D.8)
double left_by_refinement(double ratio);
/// The same of what the coarser one is wrong by.
double wrong_before_refinement(double ratio);

/// Allows what step and mesh of the model may be wrong by. coarse: residual of the coarser model as it is [n]. (D.8)
void allow_numerics(EffectProblem& problem, const VectorXd& coarse);

}  // namespace tether
