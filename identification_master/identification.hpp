#pragma once

#include <cmath>
#include <functional>

#include "identification_master/data_precision.hpp"
#include "identification_master/ensemble.hpp"
#include "identification_master/lasting_columns.hpp"
#include "identification_master/reduced_order_filter.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// When and how an identification corrects.
struct IdentificationPlan {
  double start = 0, dt = 0;  ///< [time]
  std::int64_t steps = 0;
  bool every_step = true;    ///< else only steps with frames
  bool corrects = true;      ///< else particles stay as they are, and only what data would tell is noted
  double reject_beyond = 0;  ///< predicted standard deviations; 0: nothing is rejected
  double memory_time = 0;    ///< 0: nothing is forgotten
  double largest_shift = 2;  ///< of a correction, in deviations

  double time_at(std::int64_t step) const { return start + static_cast<double>(step) * dt; }
  StepEnds ends() const { return {.start = start, .dt = dt, .length = time_at(steps) - start}; }
};

/// What is known after a step.
struct EstimateRecord {
  double time = 0;
  VectorXd mean;        ///< of theta
  MatrixXd covariance;  ///< of theta
  double data = 0;      ///< effective number of independent data in this step
  double chi_square = 0;
  double expected_chi_square = 0;  ///< if model and noise are right
  double rejected = 0;             ///< effective number of data beside them that were left out as outliers
  double tempering = 1;            ///< share of the rest that was used
  double evaluations = 0;          ///< of the coupled model, mean over the particles

  double rejected_share() const { return rejected > 0 ? rejected / (data + rejected) : 0; }
  /// All of them in order, for a checkpoint; the visitor may read or write them.
  static void numbers(auto& self, auto&& visit) {
    visit(self.time), visit(self.data), visit(self.chi_square), visit(self.expected_chi_square), visit(self.rejected),
        visit(self.tempering), visit(self.evaluations);
  }
};

/// How the model's observations change with the parameters at the end of a step, source after source.
struct StepSensitivities {
  double time = 0;
  MatrixXd changes;            ///< [m x p] per prior deviation of theta
  VectorXd precision;          ///< [m] zero where there is no datum
  std::vector<bool> on_frame;  ///< [m] whether it is a frame's own
};

/// Of all steps so far.
struct DataTotals {
  double data = 0, used = 0, rejected = 0;  ///< effective numbers of independent data; used: after tempering
  double chi_square = 0, expected_chi_square = 0;
  int tempered_steps = 0;

  void add(const EstimateRecord& step);
  static void numbers(auto& self, auto&& visit) {
    visit(self.data), visit(self.used), visit(self.rejected), visit(self.chi_square), visit(self.expected_chi_square),
        visit(self.tempered_steps);
  }
};

/// How the discrepancies of the mean behave from frame to frame of a series: about zero if model and noise are right.
/// Sums over pairs of successive frames, with the later one's precision.
struct InnovationStatistics {
  double products = 0, squares = 0, squares_before = 0;
  /// From -1 to 1.
  double autocorrelation() const { return products == 0 ? 0 : products / std::sqrt(squares * squares_before); }
};

/// Everything that an identification needs to continue.
struct IdentificationState {
  std::int64_t step = 0;
  MatrixXd theta, states;  ///< one particle a column
  std::vector<std::vector<double>> memories;
  EstimateRecord last;  ///< of this step; the prior before the first
  DataTotals totals;
  InnovationStatistics innovations;
  VectorXd last_mean;  ///< discrepancy of the mean at each datum's last frame; NaN before the first
  LastingErrors lasting;
  /// If nothing is corrected: of all data so far, of theta and the errors that last [(p+q) x (p+q)]; what was known of
  /// those that are over is left to theta and the others.
  MatrixXd information;
};

/// The filter's cycle: sample, predict, correct (K.3, K.4), once a time step.
class Identification {
 public:
  /// All must outlive it. lasting: what data may be off by. Throws InputError if the model has no
  /// observable that data are compared with.
  Identification(IdentificationPlan plan, const IdentifiedParameters& parameters, const DataPrecision& precision,
                 const Observations& observations, Ensemble& ensemble, LastingColumns lasting = {});

  /// One step of all particles, and its correction.
  void advance();
  bool is_done() const { return state_.step >= plan_.steps; }

  const IdentificationPlan& plan() const { return plan_; }
  const IdentificationState& state() const { return state_; }
  /// Continues from such a state. Throws InputError if it does not fit.
  void restore(IdentificationState state);
  const EstimateRecord& last() const { return state_.last; }
  /// What the data may be off by at all times; state().lasting has what was found of it, in these deviations.
  const std::vector<LastingError>& lasting_errors() const { return lasting_.errors(); }
  /// Called in each observed step if nothing is corrected.
  void report_sensitivities(std::function<void(const StepSensitivities&)> to) { report_ = std::move(to); }

 private:
  struct Data {
    MatrixXd discrepancies;  ///< data minus model, one particle a column
    DatumWeights weights;
  };
  bool is_observed(std::int64_t step) const;
  Data gather(const std::vector<ParticleReport>& reports, double time) const;
  std::vector<SeenRow> rows_of(const ParticleReport& report, double time) const;
  double effective_number(const Data& data) const;
  void reject_outliers(Data& data) const;
  void correct(const std::vector<ParticleReport>& reports, double time, EstimateRecord& record);
  void note_innovation(const VectorXd& mean, const DatumWeights& weights);
  void note_sensitivities(const std::vector<ParticleReport>& reports, double time, EstimateRecord& record);
  void begin_errors_of_new_frames(double before, double end);
  MatrixXd covariance_left() const;
  void diffuse_and_forget();

  IdentificationPlan plan_;
  const IdentifiedParameters& parameters_;
  const DataPrecision& precision_;
  std::vector<const Measurement*> blood_;  ///< sources behind the samples of lumen data
  ModelMoment moment_;                     ///< with the names and points that they ask for
  Ensemble& ensemble_;
  LastingColumns lasting_;
  ReducedOrderFilter filter_;
  IdentificationState state_;
  std::function<void(const StepSensitivities&)> report_;
};

}  // namespace tether
