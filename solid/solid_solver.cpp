#include "solid/solid_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// So many solves more than a young factor would have needed, and it has served its time: a new one costs as much as
/// they do, with the products between them.
constexpr double calls_for_a_factor = 15;
constexpr double young = 5;                    ///< steps
constexpr double rough = 0.01;                 ///< of a solve: that the factor is of another step spoils it by more
constexpr double newton_tolerance = 1e-9;      ///< of the correction, relative to the iterate
constexpr double rounding = 1e-14;             ///< smallest change of position that the forces can tell, over the size
constexpr double correction_tolerance = 1e-4;  ///< of each correction's conjugate gradients: Newton repeats them anyway
constexpr double tangent_tolerance = 1e-10;    ///< of a linearised answer's
constexpr int most_newton_iterations = 15, most_linear_iterations = 200;

}  // namespace

SolidSolver::SolidSolver(WallModel& model)
    : model_(model),
      nodes_(Mark().add(model.mesh().points.reshaped())),
      displacement_(Points::Zero(3, model.mesh().points.cols())),
      velocity_(displacement_),
      mean_velocity_(displacement_),
      drift_(displacement_),
      iterate_(displacement_),
      tangent_(model.elements().zero_matrix()),
      factor_(symmetric_solver(model.share())) {
  origin_.displacement = displacement_;
  origin_.parameters = model.parameters().values();
}

void SolidSolver::begin_step(double time, double dt) {
  time_ = time;
  dt_ = dt;
  iterate_ = mean_velocity_;
  for (const int unknown : model_.clamped_unknowns()) iterate_.reshaped()[unknown] = 0;  // of a clamp just set
  place_driven();
  drift_.setZero();
  evaluations_ = 0;
  calls_ = calls_for_last_ = 0;
  first_estimate_ = last_estimate_ = 0;
  tangent_serves_ = false;
  model_.place_supports(displacement_);
  renew_factor_if_stale();
}

/// The velocity that brings driven nodes to where they must be at the end of the step. Their u0 is that of the motion:
/// from (S.5) it would ring, odd-even, about a velocity that does not start from rest. (S.23)
void SolidSolver::place_driven() {
  for (const DrivenRing& ring : model_.driven()) {
    const AffineDisplacement end = ring.anchor.at(time_ + dt_), before = ring.anchor.at(time_ - dt_ / 2),
                             after = ring.anchor.at(time_ + dt_ / 2);
    for (const int node : ring.nodes) {
      const Vec3 x = model_.mesh().points.col(node);
      iterate_.col(node) = (end.at(x) - displacement_.col(node)) / dt_;
      velocity_.col(node) = (after.at(x) - before.at(x)) / dt_;
    }
  }
}

VectorXd SolidSolver::residual(const VectorXd& correction, const Points& load) {
  if (correction.size() > 0) iterate_.reshaped() += correction;
  // A correction always follows the first evaluation. Its tangent serves the second correction too, which is small: the
  // same evaluations and Krylov iterations, a quarter less work. After later evaluations `product` makes another.
  const int earlier = evaluations_++;
  VectorXd result = out_of_balance(load, earlier == 0);
  tangent_serves_ = earlier <= 1;
  return result;
}

VectorXd SolidSolver::out_of_balance(const Points& load, bool renew_tangent) {
  estimates_ = true;
  VectorXd result =
      -model_.step_forces(drifted_start(), velocity_, iterate_, time_, dt_, renew_tangent ? &tangent_ : nullptr);
  tangent_serves_ = renew_tangent;
  result.head(load.size()) += load.reshaped();
  for (int unknown : model_.clamped_unknowns()) result[unknown] = 0;
  return result;
}

VectorXd SolidSolver::product(const VectorXd& direction) {
  VectorXd result = current_tangent() * direction;
  model_.share().complete(result);
  return result;
}

VectorXd SolidSolver::precondition(const VectorXd& residual) {
  VectorXd rhs = residual;
  for (int unknown : model_.clamped_unknowns()) rhs[unknown] = 0;
  VectorXd solution = factor_->solve(rhs);
  if (std::exchange(estimates_, false)) {
    last_estimate_ = solution.norm();
    if (calls_ == 0) first_estimate_ = last_estimate_;
    calls_for_last_ = calls_;
  } else {
    ++calls_;
  }
  return solution;
}

InterfaceMotion SolidSolver::evaluate(const Points& load) {
  for (int iteration = 0; iteration < most_newton_iterations; ++iteration) {
    VectorXd correction = VectorXd::Zero(iterate_.size());
    const bool solved = solve_linear(out_of_balance(load, true), correction, correction_tolerance).converged;
    if (!correction.allFinite())
      throw run_error("the wall's equations: the correction of Newton iteration {} is not finite", iteration + 1);
    iterate_.reshaped() += correction;
    tangent_serves_ = false;
    const double least = rounding * model_.mesh().points.norm() / dt_;
    if (solved && correction.norm() <= std::max(newton_tolerance * iterate_.norm(), least)) return interface_motion();
  }
  throw run_error("the wall's equations did not converge in {} Newton iterations", most_newton_iterations);
}

InterfaceMotion SolidSolver::tangent(const Points& load_change) {
  VectorXd rhs = VectorXd::Zero(iterate_.size()), change = VectorXd::Zero(iterate_.size());
  rhs.head(load_change.size()) = load_change.reshaped();
  for (int unknown : model_.clamped_unknowns()) rhs[unknown] = 0;
  current_tangent();
  if (!solve_linear(rhs, change, tangent_tolerance).converged)
    throw run_error("the wall's linearised equations did not converge");
  return interface_part(change);
}

InterfaceMotion SolidSolver::interface_motion() const {
  InterfaceMotion motion = interface_part(iterate_.reshaped());
  motion.displacement += (displacement_ + dt_ * drift_).leftCols(model_.mesh().interface_nodes);
  return motion;
}

/// From here the step's mean velocity leads to the displacement y0 + theta dt (V + drift) where the forces are taken.
Points SolidSolver::drifted_start() const {
  return displacement_ + model_.settings().theta * dt_ * drift_;
}

void SolidSolver::set_drift(const Points& rate) {
  drift_ = rate;
  tangent_serves_ = false;
}

void SolidSolver::displace(const Points& change) {
  displacement_ += change;
}

InterfaceMotion SolidSolver::interface_part(const VectorXd& velocity) const {
  const Points v = Eigen::Map<const Points>(velocity.data(), 3, model_.mesh().interface_nodes);
  return {dt_ * v, v};
}

void SolidSolver::accept() {
  const double theta = model_.settings().theta;
  displacement_ += dt_ * (iterate_ + drift_);
  velocity_ = (iterate_ - (1 - theta) * velocity_) / theta;
  mean_velocity_ = iterate_;
  if (last_estimate_ > 0 && last_estimate_ < first_estimate_)
    origin_.count(calls_for_last_, std::log10(first_estimate_ / last_estimate_));
  time_ += dt_;
}

void SolidSolver::rewind() {
  iterate_ = mean_velocity_;
}

std::vector<Vec3> SolidSolver::support_forces() const {
  std::vector<Vec3> forces;
  for (const SurfaceSupport& support : model_.supports())
    forces.push_back(support.resultant({displacement_, mean_velocity_, time_, 0.0}));
  return forces;
}

KrylovResult SolidSolver::solve_linear(const VectorXd& rhs, VectorXd& x, double tolerance) {
  return conjugate_gradients([this](const VectorXd& v) { return product(v); },
                             [this](const VectorXd& r) { return precondition(r); }, rhs, x, tolerance,
                             most_linear_iterations);
}

const SparseMatrix& SolidSolver::current_tangent() {
  if (!tangent_serves_) assemble_tangent();
  return tangent_;
}

void SolidSolver::assemble_tangent() {
  model_.step_forces(drifted_start(), velocity_, iterate_, time_, dt_, &tangent_);
  tangent_serves_ = true;
}

void SolidSolver::renew_factor_if_stale() {
  if (origin_.dt == dt_ && origin_.lost < calls_for_a_factor) return;
  make_factor({displacement_, time_, dt_, model_.parameters().values()});
}

/// Of a step that starts and stays at origin.displacement (S.11). The model is afterwards as it was, also where this
/// throws.
void SolidSolver::assemble_tangent_at(const FactorOrigin& origin) {
  const auto set_all = [this](const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) model_.parameters().entries()[i].set(values[i]);
  };
  const auto set_back = [&, now = model_.parameters().values()] {
    set_all(now);
    model_.place_supports(displacement_);
  };
  const Points still = Points::Zero(3, origin.displacement.cols());
  tangent_serves_ = false;
  try {
    set_all(origin.parameters);
    model_.place_supports(origin.displacement);
    model_.step_forces(origin.displacement, still, still, origin.time, origin.dt, &tangent_);
  } catch (...) {
    set_back();
    throw;
  }
  set_back();
}

void SolidSolver::make_factor(const FactorOrigin& origin) {
  assemble_tangent_at(origin);
  origin_.dt = 0;  // where it cannot be factored there is none
  if (!factor_->has_factor()) factor_->analyze(tangent_, 3);
  factor_tangent();
  origin_ = origin;
}

/// A wall that buckles is carried through it by its mass, but its tangent is indefinite: then the factor is that of one
/// whose diagonal is larger, by the least power of ten that makes it definite. (S.11)
void SolidSolver::factor_tangent() {
  if (factor_->factor_roughly(tangent_, rough)) return;
  const VectorXd diagonal = tangent_.diagonal().cwiseAbs();
  for (const double more : {1e-3, 1e-2, 1e-1, 1.0, 1e1}) {
    SparseMatrix stiffer = tangent_;
    stiffer.diagonal() += more * diagonal;
    if (factor_->factor_roughly(stiffer, rough)) return;
  }
  throw run_error("the wall's tangent is not positive definite: it folds");
}

/// What a step cost with this factor: its age shows in how little a call removes, not in how many there were. (S.11)
void SolidSolver::FactorOrigin::count(int step_calls, double step_decades) {
  if (++steps <= young) {
    calls += step_calls;
    decades += step_decades;
  } else {
    lost = std::max(0.0, lost + step_calls - calls / decades * step_decades);
  }
}

bool SolidSolver::FactorOrigin::makes_same_factor_as(const FactorOrigin& other) const {
  return time == other.time && dt == other.dt && displacement == other.displacement && parameters == other.parameters;
}

double SolidSolver::mark_of(const FactorOrigin& origin) const {
  Mark mark;
  mark.add(origin.displacement.reshaped()).add(origin.parameters).add(std::array{origin.time, origin.dt});
  for (const ParameterTable::Entry& entry : model_.parameters().entries()) mark.add(entry.name);
  return mark.value();
}

Eigen::Index SolidSolver::state_size() const {
  return 4 * displacement_.size() + 8 + static_cast<Eigen::Index>(origin_.parameters.size());
}

VectorXd SolidSolver::state() const {
  VectorXd state(state_size());
  state << displacement_.reshaped(), velocity_.reshaped(), mean_velocity_.reshaped(), nodes_.value(),
      origin_.displacement.reshaped(), origin_.time, origin_.dt, origin_.steps, origin_.calls, origin_.decades,
      origin_.lost, mark_of(origin_),
      Eigen::Map<const VectorXd>(origin_.parameters.data(), static_cast<Eigen::Index>(origin_.parameters.size()));
  return state;
}

void SolidSolver::set_state(const VectorXd& state) {
  const Eigen::Index n = displacement_.size(), factor = 3 * n + 1;
  if (state.size() < factor || !nodes_.is(state[3 * n]))
    throw input_error("a state of {} numbers belongs to another wall: one with these {} nodes has {}", state.size(),
                      displacement_.cols(), state_size());
  displacement_.reshaped() = state.head(n);
  velocity_.reshaped() = state.segment(n, n);
  mean_velocity_.reshaped() = state.segment(2 * n, n);
  iterate_ = mean_velocity_;
  if (state.size() != state_size()) return;
  FactorOrigin origin;
  origin.displacement = Eigen::Map<const Points>(state.data() + factor, 3, displacement_.cols());
  const double* numbers = state.data() + factor + n;
  origin.time = numbers[0];
  origin.dt = numbers[1];
  origin.steps = numbers[2];
  origin.calls = numbers[3];
  origin.decades = numbers[4];
  origin.lost = numbers[5];
  origin.parameters.assign(numbers + 7, state.data() + state.size());
  if (mark_of(origin) == numbers[6]) restore_factor(origin);
}

/// The factor of that origin, made if it is not at hand; none if there was none.
void SolidSolver::restore_factor(const FactorOrigin& origin) {
  if (origin.dt > 0 && !origin.makes_same_factor_as(origin_)) make_factor(origin);
  origin_ = origin;
}

}  // namespace tether
