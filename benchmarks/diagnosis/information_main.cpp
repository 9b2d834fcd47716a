/// How much of what data tell of a hidden effect a diagnosis makes use of.
///
///     diagnosis_information CASE.yaml DIR [NAME...]
///
/// CASE.yaml: data without errors, whose noise is stated as if they had some: what is left of them is what is hidden,
/// d. Prints lines of what is allowed beside it, in which frames, what, and its z. DIR: of `tether diagnose` of this
/// model on any data, if there are NAMEs; else one run is made there.
///
///     nuisances   a uniform offset, a shift and a slope along the vessel of each frame, of any size
///     allowed     what a diagnosis allows, and the model off by a tenth of what it may be, or by all of it
///
///     known       (d'M d)^(1/2): by how many deviations a test sees d that knows its form
///     gaussian    the same where errors are alike as exp(-r^2/(2 l^2)), which M does not know
///     NAME        of the candidates with this name to first order, the largest
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>

#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/living_runs.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/evidence/whitening.hpp"

using namespace tether;
using Index = Eigen::Index;

namespace {

constexpr double nugget = 0.15;  ///< of the variance, not alike even between neighbours (D.18)
constexpr std::array discrepancies{0.1, 1.0};

CommandLine quiet() {
  CommandLine command;
  command.quiet = true;
  return command;
}

/// A displacement and a uniform offset of each frame, and one that grows along the vessel, over the data [n x 5
/// frames].
MatrixXd nuisances_of(const Evidence& evidence) {
  constexpr Index each = 5;
  MatrixXd all = MatrixXd::Zero(evidence.normals().cols(), each * static_cast<Index>(evidence.parts().size()));
  for (std::size_t k = 0; k < evidence.parts().size(); ++k) {
    const Evidence::Part& part = evidence.parts()[k];
    auto own = all.block(part.first, each * static_cast<Index>(k), part.count, each);
    own.leftCols(3) = evidence.normals().middleCols(part.first, part.count).transpose();
    own.col(3).setOnes();
    own.col(4) = Eigen::Map<const VectorXd>(evidence.along().data() + part.first, part.count);
  }
  return all;
}

EffectProblem allowing(EffectProblem problem, const MatrixXd& free) {
  problem.allowed = free;
  problem.allowed_deviation = VectorXd::Constant(free.cols(), infinite);
  return problem;
}

EffectProblem with_all_frames(EffectProblem problem) {
  problem.training.insert(problem.training.end(), problem.held_out.begin(), problem.held_out.end());
  problem.held_out.clear();
  return problem;
}

FinishedMotion base_of(const DiagnosedCase& given, const std::filesystem::path& folder) {
  const auto candidates = folder / "candidates.yaml";
  if (!exists(candidates)) write_candidates(candidates, given.file, given.data, {});
  return LivingRuns(quiet(), candidates, folder).make({base_run()}).front();
}

/// What each number does, on the coarser model.
Sensitivities sensitivities_in(const DiagnosedCase& given, const std::filesystem::path& folder) {
  const auto file = write_coarse(folder / "candidates.yaml", given);
  MappedRuns coarse(std::make_unique<LivingRuns>(quiet(), file, folder), given.lumen, lumen_in(file),
                    file.stem().string());
  const std::vector<PlacedEffect> effects = catalogue_of(given.file, given.diagnosis);
  Sensitivities all =
      sensitivities_of(coarse, varied_numbers(coarse.parameters(), effects, given.diagnosis, given.file));
  all.is_coarse = true;
  return all;
}

class Information {
 public:
  Information(const DiagnosedCase& given, const FinishedMotion& base)
      : evidence_(given.data, given.lumen, base),
        whitening_(evidence_, evidence_.problem()),
        of_one_(whitening_(MatrixXd::Identity(evidence_.places().cols(), evidence_.places().cols()))) {}

  void tell_beside_nuisances() const {
    tell("nuisances", allowing(whitening_(evidence_.problem()), whitening_(nuisances_of(evidence_))), {});
  }
  void tell_beside_allowed(const DiagnosedCase& given, const FinishedMotion& base, const Sensitivities& sensitivities,
                           const std::vector<std::string>& names) const {
    const auto effects = catalogue_of(given.file, given.diagnosis);
    const EffectProblem white = whitening_(problem_of(given, evidence_, base, sensitivities, effects));
    for (const double size : discrepancies) tell(fmt::format("allowed {}", size), with_discrepancy(white, size), names);
  }

 private:
  void tell(const std::string& beside, const EffectProblem& problem, const std::vector<std::string>& names) const {
    tell(beside + ",training", problem.training, problem, names);
    tell(beside + ",all", with_all_frames(problem).training, problem, names);
  }
  void tell(const std::string& of, const std::vector<Index>& rows, const EffectProblem& problem,
            const std::vector<std::string>& names) const {
    const AllowedErrors allowed(problem.precision(rows), problem.allowed(rows, Eigen::all), problem.allowed_deviation);
    const VectorXd hidden = problem.residual(rows), weighted = allowed(hidden);
    const double square = hidden.dot(weighted);
    print(of, "known", std::sqrt(square));
    print(of, "gaussian", square / std::sqrt(gaussian_variance(of_one_(rows, Eigen::all).transpose() * weighted)));
    const Scores scores = scores_of(allowed, problem.changes(rows, Eigen::all), hidden);
    for (const std::string& name : names) print(of, name, largest_of(name, problem, scores));
  }
  static void print(const std::string& of, const std::string& what, double z) {
    std::cout << fmt::format("{},{},{:.3f}\n", of, what, z);
  }

  static double largest_of(const std::string& name, const EffectProblem& problem, const Scores& scores) {
    double largest = 0;
    for (const Candidate& candidate : problem.candidates)
      if (candidate.name == name)
        for (const Index own : candidate.amplitudes)
          largest = std::max(largest, std::abs(scores.response(own)) / std::sqrt(scores.information(own, own)));
    return largest;
  }

  /// Of the sum of errors with these weights, whose correlation is a Gaussian of the stated length.
  double gaussian_variance(const VectorXd& weights) const {
    double variance = 0;
    for (const Evidence::Part& part : evidence_.parts()) {
      const Noise noise = evidence_.noise(part);
      for (Index i = part.first; i < part.first + part.count; ++i)
        for (Index j = part.first; j < part.first + part.count; ++j) {
          const double apart =
              (evidence_.places().col(i) - evidence_.places().col(j)).norm() / noise.correlation_length;
          const double alike = i == j ? 1 : (1 - nugget) * std::exp(-apart * apart / 2);
          variance += noise.deviation * noise.deviation * alike * weights(i) * weights(j);
        }
    }
    return variance;
  }

  Evidence evidence_;
  Whitening whitening_;
  MatrixXd of_one_;  ///< what each datum does to the numbers that are independent
};

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::cerr << "diagnosis_information CASE.yaml DIR [NAME...]\n";
    return 2;
  }
  const DiagnosedCase given(words[1]);
  const auto folder = std::filesystem::absolute(words[2]);
  std::filesystem::create_directories(folder);
  const FinishedMotion base = base_of(given, folder);
  const Information information(given, base);
  information.tell_beside_nuisances();
  if (count > 3)
    information.tell_beside_allowed(given, base, sensitivities_in(given, folder), {words + 3, words + count});
  return 0;
}
