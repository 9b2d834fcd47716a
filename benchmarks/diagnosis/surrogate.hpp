#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/model_runs.hpp"
#include "diagnosis/evidence/whitening.hpp"
#include "diagnosis/search/division.hpp"
#include "diagnosis/search/effect_search.hpp"

namespace tether {

/// Where drawn data differ from what a diagnosis takes them for.
struct DrawnOtherwise {
  double deviation = 1, length = 1;  ///< of the noise, over what is stated
  bool gaussian = false;             ///< exp(-r^2/(2 l^2)) in place of exp(-r/l)
  bool lasting = false;              ///< what the model itself is off is the same in all frames of a place
  bool flattens = false;             ///< effects saturate where they do most, not as a whole
};

/// What the model lacks: candidates, and their first amplitudes over what the data just show.
using Hidden = std::vector<std::pair<std::size_t, double>>;

/// A case whose sensitivity runs are there: data are drawn in place of runs, to first order, and saturate.
struct Surrogate {
  /// folder: of `tether diagnose`; runs of a coarser model are taken where they are.
  Surrogate(const std::string& case_file, const std::filesystem::path& folder);

  /// Noise, and errors allowed; what the model itself is off is so many times what it may be.
  VectorXd errors(std::uint64_t seed, double discrepancy = 1, const DrawnOtherwise& how = {}) const;
  VectorXd amplitudes(const Hidden& hidden) const;
  VectorXd effect_of(const VectorXd& amplitudes, const DrawnOtherwise& how = {}) const;
  /// without: candidates that explain nothing.
  SearchResult search(const VectorXd& residual, const std::vector<std::size_t>& without = {},
                      const DrawnOtherwise& how = {}) const;

  DiagnosedCase given;
  std::unique_ptr<ModelRuns> runs;
  std::vector<PlacedEffect> effects;
  Sensitivities sensitivities;
  Evidence evidence;
  EffectProblem as_measured;
  Whitening whitening;
  EffectProblem problem;
  SearchSettings settings;
  std::vector<double> visible;     ///< what the data just show, of each candidate
  std::vector<std::size_t> shown;  ///< effects that the data can show at a size that they may have
  VectorXd saturation;             ///< of each amplitude

 private:
  VectorXd noise(std::uint64_t seed, const DrawnOtherwise& how) const;
  VectorXd discrepancy(std::uint64_t seed, bool lasting) const;
  Eigen::ArrayXd first_runs() const;
};

/// What a trial came to: right, alike (the hidden one is in the group that is named), careful (names nothing, or an
/// ambiguity without it), missed, in part, or wrong.
std::string judgement(const SearchResult& result, const std::vector<std::size_t>& hidden, Verdict verdict);
bool accepts(const SearchResult& result, std::size_t candidate);
/// "visco_elastic at spine".
std::string name_of(const Candidate& candidate);

}  // namespace tether
