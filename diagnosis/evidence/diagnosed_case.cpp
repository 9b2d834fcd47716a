#include "diagnosis/evidence/diagnosed_case.hpp"

#include "common/base/error.hpp"
#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/data_errors.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/evidence/patterns.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

void check_noise_of(const MeasurementFacts& facts, const std::string& where) {
  const bool in_place = facts.kind.fallible.in_place;
  if (facts.noise.deviation > 0 && (!in_place || facts.noise.correlation_length > 0)) return;
  throw input_error(
      "{}: {}: noise.deviation{} must be given: how far data err, and how far errors are alike, decides what they "
      "can tell",
      where, facts.name, in_place ? " and noise.correlation_length" : "");
}

}  // namespace

DiagnosedCase::DiagnosedCase(const fs::path& path) : inputs(path), file(path) {
  file.read("mesh", mesh);
  file.read("observations", observations);
  file.read("diagnosis", diagnosis);
  file.finish();
  lumen = lumen_of(load_mesh(mesh, file, WallElement::prism));
  data = load_observations(observations, lumen, file);
  const std::string where = file.where("observations");
  if (data.all().empty()) throw input_error("{}: names nothing that was measured", where);
  for (const Measurement* source : data.all()) check_noise_of(source->facts(), where);
}

bool DiagnosedCase::asks_numerics() const {
  if (diagnosis.numerics != "where_needed") return diagnosis.numerics == "true";
  return mesh.source == "swept" && !has_coarser_mesh(mesh);
}

EffectProblem problem_of(const DiagnosedCase& given, const Evidence& evidence, const FinishedMotion& base,
                         const Sensitivities& sensitivities, const std::vector<PlacedEffect>& effects) {
  const UnitSystem& units = given.file.units();
  AllowanceCase allowed = given.diagnosis.allowed;
  if (!allowed.time_shift) allowed.time_shift = 0.5 * given.file.common().time.step;
  EffectProblem problem = evidence.problem();
  std::vector<const FinishedMotion*> all;
  for (const FinishedMotion& motion : sensitivities.motions) all.push_back(&motion);
  const MatrixXd residuals = evidence.residuals(all);
  add_model_changes(problem, {sensitivities.varied, residuals, sensitivities.is_coarse}, effects, given.diagnosis);
  problem.left_by_refinement = left_by_refinement(coarser_by(given.mesh));
  if (sensitivities.is_coarse) allow_numerics(problem, residuals.col(0));
  add_data_errors(problem, evidence, base, allowed, units, given.diagnosis.also);
  add_patterns(problem, evidence, allowed, base.motion.start, base.motion.end);
  return problem;
}

MatrixXd residuals_of(const Evidence& evidence, const std::vector<FinishedMotion>& motions, const VectorXd& otherwise) {
  std::vector<const FinishedMotion*> all;
  for (const FinishedMotion& motion : motions) all.push_back(&motion);
  const MatrixXd residuals = evidence.residuals(all);
  MatrixXd filled = residuals.array().isFinite().select(residuals, otherwise.replicate(1, residuals.cols()));
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (motions[k].failed()) filled.col(static_cast<Eigen::Index>(k)).setConstant(undefined);
  return filled;
}

}  // namespace tether
