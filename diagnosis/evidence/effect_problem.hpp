#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/effect.hpp"
#include "common/catalogue/extent.hpp"
#include "diagnosis/evidence/scores.hpp"
#include "diagnosis/results/finding.hpp"
#include "diagnosis/results/lack_of_fit.hpp"

namespace tether {

/// A number that may differ from what the model says. Its amplitude is 0 as the model is.
struct Amplitude {
  std::string name, meaning, unit;             ///< name: by its place in the case; of an error of the data its own
  bool one_sided = false;                      ///< cannot be negative
  double scale = undefined;                    ///< how large it may be in a patient
  double base = 0;                             ///< value of the model
  bool doubles = false;                        ///< the value is base 2^amplitude, not base + amplitude
  double lower = -infinite, upper = infinite;  ///< of the value
  double step = 0;                             ///< of the run that showed what it does; 0: to first order
  bool is_coarse = false;                      ///< that run was one of a coarser model
  /// The admissible one that is nearest: its value is short of the bounds by a hundredth of the way from the base; what
  /// doubles does so ten times at most.
  double limited(double amplitude) const;
  double value(double amplitude) const;  ///< of the admissible one
};

/// Which data are wrong.
struct DataPlace {
  std::string field;         ///< of the source in the case: observations.surfaces.ct
  double frame = undefined;  ///< of one frame its number, as the case counts them
  Vec3 middle{0, 0, 0};      ///< of the places that were compared [length]
};

/// Between which an amplitude is with a probability of 95 %, and what it is above as probably as below.
struct AmplitudeInterval {
  double least = 0, middle = 0, most = 0;
};

/// What may be missing or wrong: one effect at one place.
struct Candidate {
  using Kind = CandidateKind;
  std::string name, where, meaning;
  Kind kind = Kind::effect;
  std::vector<Eigen::Index> amplitudes;  ///< numbers of its amplitudes
  bool confirmable = true;               ///< it acts on held-out data as well
  std::string parameter = {};            ///< the only one of the effect's numbers that differs; empty: all of them
  DataPlace data = {};                   ///< of an error of the data
  std::string variant_of = {};           ///< the effect that it is a special shape of
  std::string type = {}, part = {},
              number = {};     ///< of an effect, new or in the model: what, where, which of its numbers
  Extent extent = {};          ///< of the part, where in it it acts
  std::string mostly_in = {};  ///< of a patch without a part, the region that has more than half of it
  double one_of = 1;           ///< how many such patches the wall has
  bool is_tried = false;       ///< on one of several patches that are compared
  /// Whether the model is run with it; what the data or the numerics do follows to first order.
  bool takes_runs() const { return kind == Kind::effect || kind == Kind::input; }
};

/// Squared cosine of what two candidates do above which they do much the same: one leaves less than half of the square
/// of what the other does.
constexpr double look_alike = 0.5;

/// Whether one candidate is a special shape of the other at the same place, as normal_visco_elastic is a visco_elastic
/// support, or the same in a part of its place. Which of the two it is is no other verdict.
bool is_variant(const Candidate& one, const Candidate& other);

/// A way in which data may be off that no effect has to explain: a region at a moment, or over the beat.
struct Pattern {
  std::string region;
  double time = undefined;  ///< of a moment; undefined: over the whole run
  using Form = PatternForm;
  Form form = Form::alike;
};

/// An error that is allowed. Without a name nobody may look after it; without an amplitude it has no size but in
/// deviations.
struct AllowedError {
  std::string name = {};
  std::optional<Amplitude> amplitude = {};
};

/// An allowed error that is a number of the model: what a run showed of it.
struct AllowedRun {
  Eigen::Index column = 0, run = 0;  ///< of `allowed`; of the sensitivity runs
  double step = 1;                   ///< amplitude in that run
};

/// Data set against a model, and all that might change it, to first order.
struct EffectProblem {
  VectorXd residual;        ///< r, data minus model, training and held-out [n]
  VectorXd precision;       ///< W of each [n]
  VectorXd independent;     ///< how many independent data each is [n]
  std::vector<int> block;   ///< of each: a patch of a frame, alike in its errors
  std::vector<int> moment;  ///< of each: alike for data of one moment; of a record its own
  std::vector<Eigen::Index> training, held_out;
  std::vector<Eigen::Index> sealed;  ///< of those held out: whole sources, which name nothing

  MatrixXd changes;  ///< S [n x q]
  std::vector<Amplitude> amplitudes;
  std::vector<Candidate> candidates;
  MatrixXd allowed;                          ///< N [n x k]
  VectorXd allowed_deviation;                ///< [k]
  double left_by_refinement = 0;             ///< of what a coarser model differs by, what is wrong still (D.8)
  std::vector<AllowedError> allowed_errors;  ///< [k]
  std::vector<AllowedRun> allowed_runs;
  MatrixXd patterns;                           ///< [n x g]
  VectorXd pattern_deviation;                  ///< of what the model itself may not do [g]
  std::vector<Eigen::Index> allowed_patterns;  ///< the same among `allowed`
  std::vector<Pattern> pattern_names;
};

/// Rows of all data that may name something: those at hand, then those held out, but for sources that are held out as a
/// whole.
std::vector<Eigen::Index> naming_rows(const EffectProblem& problem);

/// The same where the model itself may be off by so many times what was allowed.
EffectProblem with_discrepancy(EffectProblem problem, double size);

/// The residual with amplitudes at finite size, one column for each column of amplitudes [q x m]: runs of the model.
using ResidualAt = std::function<MatrixXd(const MatrixXd& amplitudes)>;

/// To first order, without runs.
ResidualAt linear_residual(const EffectProblem& problem);

}  // namespace tether
