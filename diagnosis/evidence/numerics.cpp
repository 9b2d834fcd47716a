#include "diagnosis/evidence/numerics.hpp"

#include <cmath>

#include "common/config/overlay.hpp"
#include "diagnosis/evidence/data_errors.hpp"

namespace tether {
namespace {

/// Refined once more and again: the sum of the steps to the limit, of the first; at least first order.
constexpr double limit = 2;

RefinedCase write(const std::filesystem::path& candidates, const DiagnosedCase& given, const std::string& name,
                  const std::string& meaning, std::vector<Overlay::Value> values) {
  const std::string suffix = "_" + name;
  const std::filesystem::path file =
      candidates.parent_path() / (beside_candidates(candidates, "refined") + suffix + ".yaml");
  const CommonCase& common = given.file.common();
  write_overlay(file, {candidates, common.name + suffix, common.titled(", refined"), values});
  return {name, meaning, file};
}

}  // namespace

std::string beside_candidates(const std::filesystem::path& candidates, const std::string& kind) {
  return kind + candidates.stem().string().substr(std::string("candidates").size());
}

std::vector<RefinedCase> write_refined(const std::filesystem::path& candidates, const DiagnosedCase& given) {
  std::vector<RefinedCase> all{write(candidates, given, "long_step",
                                     "share of what half the time step changes: its limit is at most 2",
                                     {{"time.step", number_text(given.file.common().time.step / 2)}})};
  if (given.mesh.source == "swept")
    all.push_back(write(candidates, given, "coarse_mesh",
                        "share of what twice the elements around and along change: their limit is at most 2",
                        {{"mesh.swept.around", std::to_string(2 * given.mesh.swept.around)},
                         {"mesh.swept.along", std::to_string(2 * given.mesh.swept.along)}}));
  if (all.size() > 1) all.back().changes_mesh = true;
  return all;
}

LumenSurface lumen_in(const std::filesystem::path& case_file) {
  CaseFile file(case_file);
  MeshCase mesh;
  file.read("mesh", mesh);
  return lumen_of(load_mesh(mesh, file, WallElement::prism));
}

void add_numerics(EffectProblem& problem, const RefinedCase& refined, const VectorXd& change) {
  Amplitude amplitude{"share", refined.meaning, "1", true, limit};
  amplitude.upper = limit;
  problem.candidates.push_back(
      {refined.name, {}, refined.meaning, Candidate::Kind::numerics, {problem.changes.cols()}, false});
  problem.amplitudes.push_back(amplitude);
  append_columns(problem.changes, change);
}

double left_by_refinement(double ratio) {
  return 1 / std::sqrt((ratio - 1) * (ratio * ratio - 1));
}

double wrong_before_refinement(double ratio) {
  return std::pow(ratio, 1.5) * left_by_refinement(ratio);
}

void allow_numerics(EffectProblem& problem, const VectorXd& coarse) {
  const VectorXd difference = problem.residual - coarse;
  if (difference.allFinite())
    allow(problem, difference, problem.left_by_refinement, {"error of the model's step and mesh"});
}

}  // namespace tether
