#include "identification_master/identification.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

void check_columns(const Measurement& source, const std::vector<std::string>& known) {
  for (const NeededColumn& column : source.columns()) {
    if (std::find(known.begin(), known.end(), column.name) != known.end()) continue;
    const std::string near = nearest(column.name, known);
    throw input_error("{}: the model has no observable {}; {}", source.facts().field(), column.name,
                      near.empty() ? "it has " + listed(known) : fmt::format("did you mean {}?", near));
  }
}

/// Spread of the particles over that of the prior if nothing is corrected: so near the mean, the model's curvature
/// gives no sensitivity to numbers that have none (at 1 it does), and the coupling's tolerance does not show yet.
constexpr double nearness = 0.05;

}  // namespace

void DataTotals::add(const EstimateRecord& step) {
  data += step.data;
  used += step.tempering * step.data;
  rejected += step.rejected;
  chi_square += step.chi_square;
  expected_chi_square += step.expected_chi_square;
  tempered_steps += step.tempering < 1 ? 1 : 0;
}

Identification::Identification(IdentificationPlan plan, const IdentifiedParameters& parameters,
                               const DataPrecision& precision, const Observations& observations, Ensemble& ensemble,
                               LastingColumns lasting)
    : plan_(plan),
      parameters_(parameters),
      precision_(precision),
      ensemble_(ensemble),
      lasting_(std::move(lasting)),
      filter_(parameters.prior_mean(), parameters.prior_covariance() * (plan.corrects ? 1 : nearness * nearness),
              lasting_.at(plan.start)) {
  for (const auto& observable : ensemble.model().observables) moment_.names.push_back(observable.name);
  moment_.points = observations.points();
  for (const Measurement* source : observations.FlowObservations::all()) {
    check_columns(*source, moment_.names);
    blood_.push_back(source);
  }
  const Eigen::Index particles = filter_.particles().cols();
  state_.theta = filter_.particles();
  state_.states = ensemble.initial_state().replicate(1, particles);  // L_x = 0
  state_.memories.resize(static_cast<std::size_t>(particles));
  state_.lasting = filter_.lasting();
  const Eigen::Index numbers = filter_.parameters() + state_.lasting.count();
  state_.information = MatrixXd::Zero(plan.corrects ? 0 : numbers, plan.corrects ? 0 : numbers);
  state_.last = {plan.start, parameters.prior_mean(), parameters.prior_covariance()};
}

void Identification::restore(IdentificationState state) {
  if (state.theta.rows() != state_.theta.rows() || state.states.rows() != state_.states.rows())
    throw input_error("the checkpoint is of {} parameters and a state of {} numbers; this case has {} and {}",
                      state.theta.rows(), state.states.rows(), state_.theta.rows(), state_.states.rows());
  if (state.lasting.count() != state_.lasting.count())
    throw input_error("the checkpoint knows of {} errors that last; these data have {}", state.lasting.count(),
                      state_.lasting.count());
  state_ = std::move(state);
  filter_.restore(state_.theta, state_.lasting);
}

void Identification::advance() {
  const std::int64_t step = state_.step;
  const double end = plan_.time_at(step + 1);
  std::vector<NamedValues> values;
  for (const auto& theta : filter_.particles().colwise()) values.push_back(parameters_.values(theta));
  const auto reports = ensemble_.advance({step + 1, plan_.time_at(step), plan_.dt, is_observed(step)}, values,
                                         state_.states, state_.memories);
  EstimateRecord record;
  record.time = end;
  for (const ParticleReport& report : reports)
    record.evaluations += static_cast<double>(report.evaluations) / static_cast<double>(reports.size());
  begin_errors_of_new_frames(plan_.time_at(step), end);
  if (plan_.corrects) {
    if (is_observed(step)) correct(reports, end, record);
    diffuse_and_forget();
    record.covariance = filter_.covariance();
  } else {
    record.covariance = last().covariance;
    if (is_observed(step)) note_sensitivities(reports, end, record);
  }
  record.mean = filter_.mean();
  state_.theta = filter_.particles();
  state_.lasting = filter_.lasting();
  state_.totals.add(record);
  state_.last = std::move(record);
  ++state_.step;
}

void Identification::diffuse_and_forget() {
  filter_.diffuse(parameters_.walked(plan_.dt));
  if (plan_.memory_time > 0)
    state_.states *=
        filter_.forget(std::exp(-plan_.dt / plan_.memory_time), parameters_.prior_covariance()).transpose();
}

bool Identification::is_observed(std::int64_t step) const {
  return plan_.every_step || precision_.has_frame(plan_.time_at(step + 1));
}

/// Samples of lumen data as the particle's group took them, then what the sources of the blood see of it.
std::vector<SeenRow> Identification::rows_of(const ParticleReport& report, double time) const {
  std::vector<SeenRow> rows;
  for (std::size_t i = 0; i < report.distances.size(); ++i) rows.push_back({report.distances[i], report.weights[i]});
  ModelMoment now = moment_;
  now.values = report.observables;
  now.velocities = Eigen::Map<const Points>(report.velocities.data(), 3, std::ssize(report.velocities) / 3);
  now.lumen = report.lumen;
  for (const Measurement* source : blood_) {
    const std::vector<SeenRow> seen = source->see(now, time);
    rows.insert(rows.end(), seen.begin(), seen.end());
  }
  return rows;
}

/// A datum that is none for one particle is none for all.
Identification::Data Identification::gather(const std::vector<ParticleReport>& reports, double time) const {
  const Eigen::Index count = precision_.deviations().size();
  Data data{MatrixXd(count, std::ssize(reports)), {}};
  VectorXd weights = VectorXd::Constant(count, infinite);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const std::vector<SeenRow> rows = rows_of(reports[i], time);
    TETHER_ASSERT(std::ssize(rows) == count, "{} rows of {}", rows.size(), count);
    for (Eigen::Index row = 0; row < count; ++row) {
      const SeenRow& seen = rows[static_cast<std::size_t>(row)];
      data.discrepancies(row, static_cast<Eigen::Index>(i)) = seen.difference;
      weights(row) = std::min(weights(row), seen.weight);
    }
  }
  data.weights = precision_.at(weights, time);
  for (Eigen::Index row = 0; row < data.discrepancies.rows(); ++row)
    if (data.weights.precision(row) == 0) data.discrepancies.row(row).setZero();  // it may be anything, NaN too
  return data;
}

/// Of independent data.
double Identification::effective_number(const Data& data) const {
  return data.weights.precision.dot(precision_.deviations().cwiseAbs2());
}

/// Leaves out data farther from the mean than the stated noise and the particles' spread explain.
void Identification::reject_outliers(Data& data) const {
  if (plan_.reject_beyond <= 0) return;
  const MatrixXd D = filter_.without_lasting(data.discrepancies);
  const VectorXd mean = ReducedOrderFilter::mean_of(D);
  VectorXd spread = ReducedOrderFilter::spread_of(D).rowwise().squaredNorm();
  if (state_.lasting.count() > 0) spread += filter_.lasting_variances();
  for (Eigen::Index row = 0; row < mean.size(); ++row) {
    const double variance = std::pow(precision_.deviations()(row), 2) + spread(row);
    if (mean(row) * mean(row) > plan_.reject_beyond * plan_.reject_beyond * variance) data.weights.precision(row) = 0;
  }
}

void Identification::correct(const std::vector<ParticleReport>& reports, double time, EstimateRecord& record) {
  Data data = gather(reports, time);
  const double before = effective_number(data);
  reject_outliers(data);
  record.data = effective_number(data);
  record.rejected = before - record.data;
  record.expected_chi_square =
      data.weights.precision.dot(precision_.deviations().cwiseAbs2().cwiseProduct(data.weights.expected_squares));
  note_innovation(ReducedOrderFilter::mean_of(filter_.without_lasting(data.discrepancies)), data.weights);
  const FilterCorrection done = filter_.correct(data.discrepancies, data.weights.precision, plan_.largest_shift);
  record.chi_square = done.chi_square;
  record.tempering = done.tempering;
  state_.states *= done.mix.transpose();  // (K.4)
}

void Identification::begin_errors_of_new_frames(double before, double end) {
  const std::vector<Eigen::Index> renewed = lasting_.renewed(before, end);
  filter_.errors_now(lasting_.at(end), renewed);
  if (plan_.corrects) return;
  MatrixXd& J = state_.information;  // whatever they are, within their deviations of 1: (K.7)
  for (const Eigen::Index error : renewed) {
    const Eigen::Index k = filter_.parameters() + error;
    const VectorXd with = J.col(k);
    J -= with * with.transpose() / (1 + with(k));
    J.row(k).setZero();
    J.col(k).setZero();
  }
}

/// Of theta, from what all data so far would tell of it and of the errors that last. (K.7)
MatrixXd Identification::covariance_left() const {
  MatrixXd joint = state_.information;
  const Eigen::Index p = filter_.parameters();
  joint.topLeftCorner(p, p) += parameters_.prior_covariance().inverse();
  joint.diagonal().tail(joint.rows() - p).array() += 1;
  return joint.inverse().topLeftCorner(p, p);
}

/// The particles stay near the prior's mean, and the data of all steps add up to what they would leave. (K.7)
void Identification::note_sensitivities(const std::vector<ParticleReport>& reports, double time,
                                        EstimateRecord& record) {
  const Data data = gather(reports, time);
  const VectorXd mean = ReducedOrderFilter::mean_of(data.discrepancies), &W = data.weights.precision;
  const MatrixXd L_theta = ReducedOrderFilter::spread_of(filter_.particles());
  const MatrixXd changes = -ReducedOrderFilter::spread_of(data.discrepancies) * L_theta.inverse() *
                           parameters_.prior_variances().cwiseSqrt().asDiagonal();
  const VectorXd scale = parameters_.prior_variances().cwiseSqrt().cwiseInverse();
  MatrixXd all(changes.rows(), state_.information.cols());
  all.leftCols(changes.cols()) = changes * scale.asDiagonal();
  if (state_.lasting.count() > 0) all.rightCols(state_.lasting.count()) = filter_.lasting_columns();
  state_.information += all.transpose() * (W.asDiagonal() * all);
  record.covariance = covariance_left();
  record.data = effective_number(data);
  record.expected_chi_square = W.dot(precision_.deviations().cwiseAbs2().cwiseProduct(data.weights.expected_squares));
  record.chi_square = mean.dot(W.asDiagonal() * mean);
  if (report_) report_({time, changes, W, data.weights.on_frame});
}

/// Each datum with itself at its series' last frame.
void Identification::note_innovation(const VectorXd& mean, const DatumWeights& weights) {
  VectorXd& last = state_.last_mean;
  if (last.size() != mean.size()) last = VectorXd::Constant(mean.size(), std::nan(""));
  for (Eigen::Index row = 0; row < mean.size(); ++row) {
    const double precision = weights.precision(row), now = mean(row), before = last(row);
    if (precision == 0 || !weights.on_frame[static_cast<std::size_t>(row)]) continue;
    if (!std::isnan(before)) {
      state_.innovations.products += precision * now * before;
      state_.innovations.squares += precision * now * now;
      state_.innovations.squares_before += precision * before * before;
    }
    last(row) = now;
  }
}

}  // namespace tether
