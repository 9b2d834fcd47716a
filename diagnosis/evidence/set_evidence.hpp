#pragma once

#include <optional>
#include <vector>

#include "diagnosis/evidence/amplitude_curve.hpp"
#include "diagnosis/evidence/effect_problem.hpp"
#include "diagnosis/evidence/set_integrand.hpp"

namespace tether {

/// Which model a run is of: that of the case, or one of coarser or finer mesh and step.
enum class RunOf { model, coarser, finer };

/// What a run showed: amplitudes of all candidates [q] and the residual with them [n]; of another than the model itself
/// less what that model differs by as it is.
struct ShownRun {
  VectorXd amplitudes, residual;
  RunOf of = RunOf::model;
};

/// How large what the model itself cannot do is, over what it is allowed, and how probable that is beforehand.
struct DiscrepancySize {
  double size = 1, prior = 1;
};

/// Factors of what is not known for sure: how large amplitudes may be, the noise's deviation, what the model itself may
/// be off.
struct Assumptions {
  double sizes = 1, noise = 1, discrepancy = 1;
};

/// How probable an amplitude is about each of these sizes, ascending; together 1.
struct AmplitudeDensity {
  VectorXd sizes, probabilities;
};

/// One of a candidate's several amplitudes.
struct OneOfSeveral {
  std::size_t candidate;
  Eigen::Index number;  ///< among its amplitudes
};

/// A set's evidence with one size of discrepancy, and the most probable amplitudes of its members; of several
/// amplitudes NaN, and no density.
struct SetFit {
  double log_evidence = 0;
  std::vector<double> amplitudes;
  std::vector<AmplitudeDensity> densities = {};
};

/// The evidence for sets of candidates: the probability of the data with their amplitudes, the allowed errors and what
/// the model cannot do all left free within their priors. (D.19)
///
/// A candidate of one amplitude does at finite size what runs of it alone showed, and has a prior of heavy tail; one of
/// several amplitudes does what it does to first order, and its prior is normal with an unknown multiple of its scale.
class SetEvidence {
 public:
  /// All data count that may name something.
  SetEvidence(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Assumptions& assumed = {});
  /// The data of these rows count.
  SetEvidence(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Assumptions& assumed,
              const std::vector<Eigen::Index>& rows);

  /// members: numbers of candidates, at most three of one amplitude. discrepancy: number of one of `discrepancies()`.
  SetFit fit(const std::vector<std::size_t>& members, std::size_t discrepancy) const;
  /// How probable the values of one amplitude of a member of several are, by what it does to first order.
  AmplitudeDensity density_of(const OneOfSeveral& told, const std::vector<std::size_t>& members,
                              std::size_t discrepancy) const;
  bool is_scalar(std::size_t candidate) const;
  /// Over all sizes of discrepancy.
  double log_evidence(const std::vector<std::size_t>& members) const;
  /// Takes for the data so much of what a candidate of that first amplitude does, and nothing else.
  void suppose(std::size_t candidate, double amplitude, double share = 1);
  /// How far the data are from the model, over what its errors with that discrepancy make.
  double signal(std::size_t discrepancy) const;
  /// Small ones first.
  const std::vector<DiscrepancySize>& discrepancies() const { return discrepancies_; }
  /// How far that is from the closest of its runs, as a factor; infinite if none was made. coarse: whether those of a
  /// coarser model count.
  double beyond_runs(std::size_t candidate, double amplitude, bool coarse) const;
  /// Of its runs of the model itself that size which is closest; none if there is none on that side.
  std::optional<double> closest_run(std::size_t candidate, double amplitude) const;
  /// Whether no run of it was as large, on that side.
  bool is_beyond_all(std::size_t candidate, double amplitude) const;
  /// What mesh and step may make wrong in what a candidate of one amplitude does at that size, by one deviation [n];
  /// none of what is known exactly.
  std::optional<VectorXd> error_of(std::size_t candidate, double size) const;
  /// Of what two candidates do to first order.
  double cosine(std::size_t a, std::size_t b) const;

 private:
  struct Grid {
    VectorXd sizes, log_weight;  ///< [g]
    MatrixXd mix;                ///< of the set's columns [g x c]
    MatrixXd error;              ///< the same of what mesh and step may be wrong by: one deviation [g x c]
    bool errs = false;           ///< whether that is anything
  };
  /// What a candidate does in the finer of two models less what it does in the other, times what that tells of the
  /// error of the model itself (D.8).
  struct ShownNumerics {
    std::size_t candidate;
    double size;
    Eigen::Index column;  ///< of that
    RunOf told_by;
    VectorXd data = {};  ///< that column, of all data
    VectorXd seen = {};  ///< products of all columns with what the candidate does at that size
    double square = 0;   ///< of what it does
  };
  /// Products of a set's columns, the residual last, in M; what errors along others leave of them is what `take_out`
  /// tells.
  struct Products {
    MatrixXd gram;
    double log_norm = 0;
  };

  /// Of all kinds that are allowed.
  struct Errors {
    MatrixXd columns;  ///< [n x e]
    VectorXd given;    ///< deviation of each of the first, which are ordinary; infinite: any
  };

  /// An amplitude that is summed over; of one of several the deviation of its normal prior.
  struct Summand {
    std::size_t candidate;
    Eigen::Index number = 0;
    double deviation = 0;
  };
  using Summands = std::vector<Summand>;

  MatrixXd columns_of_curves(const std::vector<ShownRun>& runs, const std::vector<Eigen::Index>& rows);
  Errors errors_on(const std::vector<Eigen::Index>& rows) const;
  void multiply_out(MatrixXd columns, const std::vector<Eigen::Index>& rows);

  const Amplitude& amplitude_of(const Summand& summand) const;
  std::vector<Eigen::Index> columns_of(const std::vector<std::size_t>& members) const;
  Grid grid_of(const Summand& summand, const std::vector<Eigen::Index>& columns, const VectorXd& places) const;
  VectorXd mix_at(const Summand& summand, double size, const std::vector<Eigen::Index>& columns) const;
  SetFit over_all(const std::vector<std::size_t>& members, std::size_t discrepancy, const OneOfSeveral* told) const;
  SetFit over_vectors(const std::vector<std::size_t>& vectors, std::size_t next, const Products& products,
                      const Summands& scalars, const std::vector<Eigen::Index>& columns,
                      const OneOfSeveral* told) const;
  SetFit over_scalars(const Summands& scalars, const Products& products,
                      const std::vector<Eigen::Index>& columns) const;

  static SetIntegrand integrand_of(const std::vector<Grid>& grids, const MatrixXd& gram);
  std::optional<ShownNumerics> add_refined(std::size_t candidate, const std::vector<ShownRun>& runs,
                                           MatrixXd& columns) const;
  std::optional<ShownNumerics> add_coarse(std::size_t candidate, MatrixXd& columns) const;
  void settle_numerics();
  const ShownNumerics* numerics_of(std::size_t candidate) const;

  double scale_of(const Amplitude& amplitude) const;

  const EffectProblem& problem_;
  Assumptions assumed_;
  std::vector<DiscrepancySize> discrepancies_;
  std::vector<Products> products_;                   ///< of all columns, for each discrepancy
  std::vector<std::vector<AmplitudeCurve>> curves_;  ///< of each candidate, upward and downward
  std::vector<ShownNumerics> numerics_;
  std::vector<int> errs_as_;  ///< each candidate as one of these; -1: not at all
};

}  // namespace tether
