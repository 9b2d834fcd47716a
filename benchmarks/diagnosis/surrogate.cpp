#include "surrogate.hpp"

#include <cmath>
#include <map>

#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/living_runs.hpp"
#include "diagnosis/evidence/noise_factors.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/search/detectable.hpp"
#include "diagnosis/search/diagnosis_report.hpp"
#include "twin/noise.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double trace_interval = 0.01;  ///< of values of a trace [s]
constexpr double saturates_at = 10;      ///< times what the data just show
constexpr double flat_at = 3;            ///< of the largest change that those make

CommandLine quiet() {
  CommandLine command;
  command.quiet = true;
  return command;
}

std::unique_ptr<ModelRuns> runs_in(const std::filesystem::path& folder, const DiagnosedCase& given) {
  if (!exists(folder / "coarse.yaml")) return std::make_unique<LivingRuns>(quiet(), folder / "candidates.yaml", folder);
  const auto file = write_coarse(folder / "candidates.yaml", given);
  return std::make_unique<MappedRuns>(std::make_unique<LivingRuns>(quiet(), file, folder), given.lumen, lumen_in(file),
                                      file.stem().string());
}

}  // namespace

Surrogate::Surrogate(const std::string& case_file, const std::filesystem::path& folder)
    : given(case_file),
      runs(runs_in(folder, given)),
      effects(catalogue_of(given.file, given.diagnosis)),
      sensitivities(sensitivities_of(
          *runs,
          Division(effects, varied_numbers(runs->parameters(), effects, given.diagnosis, given.file)).undivided())),
      evidence(given.data, given.lumen, sensitivities.motions.front()),
      as_measured(problem_of(given, evidence, sensitivities.motions.front(), sensitivities, effects)),
      whitening(evidence, as_measured),
      problem(whitening(as_measured)) {
  const DiagnosisCase& d = given.diagnosis;
  settings = {d.alpha, d.unexplained, 0, d.most, d.refinements, d.confirmed};
  EffectProblem drawn = problem;
  drawn.residual = errors(1);
  const SetEvidence told(drawn, {});
  visible = detectable_sizes(drawn, {}, posterior_of(drawn, told, std::vector<bool>(problem.candidates.size(), false)),
                             d.alpha);
  for (double& size : visible) size = std::abs(size);
  saturation = VectorXd::Constant(problem.changes.cols(), infinite);
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    if (problem.candidates[c].kind != Candidate::Kind::effect) continue;
    for (const Index i : problem.candidates[c].amplitudes) saturation(i) = saturates_at * visible[c];
    const double scale = problem.amplitudes[static_cast<std::size_t>(problem.candidates[c].amplitudes.front())].scale;
    if (visible[c] < 5 * scale) shown.push_back(c);
    visible[c] /= 1 + (first_runs()(problem.candidates[c].amplitudes.front()) / visible[c] - 1) / saturates_at;
  }
}

VectorXd Surrogate::noise(std::uint64_t seed, const DrawnOtherwise& how) const {
  VectorXd all(as_measured.residual.size());
  std::map<std::size_t, std::vector<const Evidence::Part*>> of_source;
  for (const auto& part : evidence.parts()) of_source[part.source].push_back(&part);
  for (const auto& [source, parts] : of_source) {
    const Noise& stated = evidence.noise(*parts.front());
    const NoiseScale scale{how.deviation * stated.deviation, how.length * stated.correlation_length,
                           stated.correlation_time};
    const std::uint64_t own = seed * 64 + source;
    if (parts.front()->is_record) {
      std::vector<double> times;  // of equally spaced values: the share of each tells nothing else
      for (Index i = 0; i < parts.front()->count; ++i) times.push_back(trace_interval * static_cast<double>(i));
      all.segment(parts.front()->first, parts.front()->count) = noise_over_time(scale, times, own);
      continue;
    }
    std::vector<double> times;
    for (const auto* part : parts) times.push_back(part->time);
    const NoiseSeries series(scale, times, own);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Points places = evidence.places().middleCols(parts[k]->first, parts[k]->count);
      all.segment(parts[k]->first, parts[k]->count) =
          how.gaussian ? scale.deviation *
                             RandomField(scale.correlation_length, Random(own, k), CorrelationShape::gaussian)(places)
                       : series(k, places);
    }
  }
  return all;
}

/// lasting: the same at all moments, with the sign of a beat's first half.
VectorXd Surrogate::discrepancy(std::uint64_t seed, bool lasting) const {
  VectorXd all = VectorXd::Zero(as_measured.residual.size());
  Random random(seed * 64 + 62, 0);
  std::map<std::pair<std::string, PatternForm>, double> of_place;
  for (Index k = 0; k < as_measured.pattern_deviation.size(); ++k) {
    const Pattern& pattern = as_measured.pattern_names[static_cast<std::size_t>(k)];
    const double own = random.normal();
    const double amplitude = lasting ? of_place.try_emplace({pattern.region, pattern.form}, own).first->second : own;
    all += amplitude * as_measured.pattern_deviation(k) * as_measured.patterns.col(k);
  }
  return all;
}

VectorXd Surrogate::errors(std::uint64_t seed, double discrepancy, const DrawnOtherwise& how) const {
  VectorXd all = noise(seed, how) + discrepancy * this->discrepancy(seed, how.lasting);
  Random random(seed * 64 + 63, 0);
  for (Index k = 0; k < problem.allowed.cols(); ++k) {
    const double size = random.normal();
    const bool is_pattern = std::find(problem.allowed_patterns.begin(), problem.allowed_patterns.end(), k) !=
                            problem.allowed_patterns.end();
    if (std::isfinite(problem.allowed_deviation(k)) && !is_pattern)
      all += problem.allowed_deviation(k) * size * as_measured.allowed.col(k);
  }
  return whitening(all);
}

VectorXd Surrogate::amplitudes(const Hidden& hidden) const {
  VectorXd all = VectorXd::Zero(problem.changes.cols());
  for (const auto& [candidate, times] : hidden)
    all(problem.candidates[candidate].amplitudes.front()) = times * visible[candidate];
  return all;
}

/// Sizes at which the changes per unit were found; 0: of an infinitesimal one.
Eigen::ArrayXd Surrogate::first_runs() const {
  Eigen::ArrayXd sizes(std::ssize(problem.amplitudes));
  for (std::size_t k = 0; k < problem.amplitudes.size(); ++k)
    sizes(static_cast<Index>(k)) = std::abs(problem.amplitudes[k].step);
  return sizes;
}

VectorXd Surrogate::effect_of(const VectorXd& amplitudes, const DrawnOtherwise& how) const {
  if (!how.flattens) {
    const Eigen::ArrayXd as_known = 1 + first_runs() / saturation.array();  // that run showed the model what it does
    const VectorXd saturated = amplitudes.array() * as_known / (1 + amplitudes.array().abs() / saturation.array());
    return problem.changes * saturated;
  }
  VectorXd all = VectorXd::Zero(as_measured.residual.size());
  for (Index k = 0; k < amplitudes.size(); ++k) {
    if (amplitudes(k) == 0) continue;
    const Eigen::ArrayXd change = as_measured.changes.col(k).array();
    const double largest = flat_at * saturation(k) / saturates_at * change.abs().maxCoeff();
    const Eigen::ArrayXd made = amplitudes(k) * change;
    all += (std::isfinite(largest) ? (made / (1 + made.abs() / largest)).eval() : made).matrix();
  }
  return whitening(all);
}

SearchResult Surrogate::search(const VectorXd& residual, const std::vector<std::size_t>& without,
                               const DrawnOtherwise& how) const {
  EffectProblem drawn = problem;
  drawn.residual = residual;
  for (auto c = without.rbegin(); c != without.rend(); ++c) {
    drawn.changes(Eigen::all, drawn.candidates[*c].amplitudes).setZero();  // it explains nothing
    for (const Index i : drawn.candidates[*c].amplitudes) drawn.amplitudes[static_cast<std::size_t>(i)].scale = 1e-300;
  }
  const VectorXd larger = larger_noise(whitening.bands(), noise_factors(drawn, whitening.bands()));
  return search_effects(with_noise(drawn, larger), settings, [&](const MatrixXd& tried) -> MatrixXd {
    MatrixXd residuals(residual.size(), tried.cols());
    for (Index k = 0; k < tried.cols(); ++k)
      residuals.col(k) = (residual - effect_of(tried.col(k), how)).cwiseQuotient(larger);
    return residuals;
  });
}

namespace {

int group_of(const SearchResult& result, std::size_t candidate) {
  for (const TestedEffect& effect : result.effects)
    if (effect.candidate == candidate) return effect.group;
  return -1;
}

/// Named itself, or in the group of one that is.
bool names(const SearchResult& result, std::size_t candidate) {
  if (accepts(result, candidate)) return true;
  const int group = group_of(result, candidate);
  for (const TestedEffect& effect : result.effects)
    if (effect.accepted && group >= 0 && effect.group == group) return true;
  return false;
}

bool names_anything(const SearchResult& result) {
  return result.verdict == Verdict::missing || result.verdict == Verdict::ambiguous;
}

}  // namespace

bool accepts(const SearchResult& result, std::size_t candidate) {
  for (const TestedEffect& effect : result.effects)
    if (effect.candidate == candidate && effect.accepted) return true;
  return false;
}

/// As benchmarks/diagnosis/run judges.
std::string judgement(const SearchResult& result, const std::vector<std::size_t>& hidden, Verdict verdict) {
  if (!names_anything(result)) {
    if (hidden.empty() && result.verdict == verdict) return "right";
    return result.verdict == Verdict::nothing_missing && !(hidden.empty() && verdict == Verdict::nothing_missing)
               ? "missed"
               : "careful";
  }
  if (hidden.empty()) return result.verdict == Verdict::ambiguous ? "careful" : "wrong";
  std::size_t itself = 0, alike = 0, accepted = 0, fitting = 0;
  for (const std::size_t h : hidden) {
    itself += accepts(result, h) ? 1 : 0;
    alike += names(result, h) ? 1 : 0;
  }
  for (const TestedEffect& effect : result.effects) {
    if (!effect.accepted) continue;
    ++accepted;
    for (const std::size_t h : hidden)
      if (effect.candidate == h || (effect.group >= 0 && effect.group == group_of(result, h))) {
        ++fitting;
        break;
      }
  }
  if (itself == hidden.size() && accepted == hidden.size() && result.verdict == Verdict::missing) return "right";
  if (alike == hidden.size() && fitting == accepted) return "alike";
  if (result.verdict == Verdict::ambiguous) return "careful";
  return hidden.size() > 1 && fitting == accepted ? "in part" : "wrong";
}

std::string name_of(const Candidate& candidate) {
  Finding finding;
  finding.name = candidate.name;
  finding.where = candidate.where;
  if (!candidate.parameter.empty()) finding.parameter = candidate.parameter;
  return tether::name_of(finding);
}

}  // namespace tether
