// State, parameters and observables of the FluidSolver: what others see of it between steps.
#include "common/base/error.hpp"
#include "fluid/fluid_solver.hpp"

namespace tether::fluid {
namespace {

/// Copies values to or from consecutive places of one vector.
class Cursor {
 public:
  explicit Cursor(Eigen::Index at = 0) : at_(at) {}
  template <class Field>
  void write(VectorXd& to, const Field& field) {
    to.segment(at_, field.size()) = field.reshaped();
    at_ += field.size();
  }
  template <class Field>
  void read(const VectorXd& from, Field& field) {
    field.reshaped() = from.segment(at_, field.size());
    at_ += field.size();
  }

 private:
  Eigen::Index at_;
};

}  // namespace

Eigen::Index FluidSolver::state_size() const {
  const Accepted& a = accepted_;
  return 2 + a.velocity.size() + a.pressure.size() + a.on_sigma.size() + 2 + a.stored.size();
}

VectorXd FluidSolver::state() const {
  const Accepted& a = accepted_;
  const Eigen::Vector2d marks(nodes_.value(), beyond_.value());
  VectorXd values(state_size());
  values[0] = a.impulse;
  values[1] = a.volume;
  Cursor cursor(2);
  cursor.write(values, a.velocity);
  cursor.write(values, a.pressure);
  cursor.write(values, a.on_sigma);
  cursor.write(values, marks);
  cursor.write(values, a.stored);
  return values;
}

void FluidSolver::set_state(const VectorXd& values) {
  const Eigen::Index size = state_size(), marks = size - 2 - accepted_.stored.size();
  if (values.size() < marks + 2 || !nodes_.is(values[marks]))
    throw input_error("a state of {} numbers belongs to another mesh of the blood: one with these {} nodes has {}",
                      values.size(), domain_.node_count(), size);
  accepted_.impulse = values[0];
  accepted_.volume = values[1];
  Cursor cursor(2);
  cursor.read(values, accepted_.velocity);
  cursor.read(values, accepted_.pressure);
  cursor.read(values, accepted_.on_sigma);
  if (values.size() == size && beyond_.is(values[marks + 1]))
    accepted_.stored = values.tail(accepted_.stored.size());
  else
    store_initial_pressures();
  derive(accepted_);
  rewind();
  forget_earlier_meshes();
}

void FluidSolver::move_interface(const Points& change) {
  Accepted moved = accepted_;
  moved.on_sigma += change;
  moved.volume += domain_.volume(moved.on_sigma) - domain_.volume(accepted_.on_sigma);
  try {
    derive(moved);
  } catch (...) {
    domain_.place(accepted_.displacement);
    throw;
  }
  accepted_ = std::move(moved);
  rewind();
}

/// The fields that the state need not carry; the mesh goes to where they put it.
void FluidSolver::derive(Accepted& state) {
  state.displacement = domain_.extend(state.on_sigma);
  domain_.place(state.displacement);
  state.carried = state.impulse * gradient(domain_.geometry(), domain_.tetrahedra(), state.pressure);
}

void FluidSolver::store_initial_pressures() {
  accepted_.stored.resize(static_cast<Eigen::Index>(openings_.size()));
  for (std::size_t i = 0; i < openings_.size(); ++i)
    accepted_.stored[static_cast<Eigen::Index>(i)] = openings_[i].beyond->initial();
}

Mark FluidSolver::mark_of_openings() const {
  Mark mark;
  for (const Opening& opening : openings_) mark.add(opening.face().name).add(opening.beyond.declaration().name);
  return mark;
}

void FluidSolver::declare_parameters() {
  parameters_.add_effect("fluid", blood_);
  parameters_.add_effect("fluid.rheology", rheology_);
  for (auto& inlet : flow_inlets_) parameters_.add_effect("fluid.inlets." + inlet.face().name, inlet.inflow);
  for (auto& opening : openings_)
    parameters_.add_effect((opening.is_inlet() ? "fluid.inlets." : "fluid.outlets.") + opening.face().name,
                           opening.beyond);
}

void FluidSolver::set_parameters(const std::vector<std::string>& names, const std::vector<double>& values) {
  parameters_.set(names, values);
  if (accepted_.impulse == 0) store_initial_pressures();
}

void FluidSolver::declare_observables() {
  for (const auto& inlet : flow_inlets_) {
    observables_.push_back({inlet.face().name + ".flow", dimension::flow});
    observables_.push_back({inlet.face().name + ".pressure", dimension::pressure});
  }
  for (const auto& opening : openings_) {
    observables_.push_back({opening.face().name + ".flow", dimension::flow});
    observables_.push_back({opening.face().name + ".pressure", dimension::pressure});
    if (opening.beyond->stores())
      observables_.push_back({opening.face().name + ".windkessel_pressure", dimension::pressure});
  }
  for (const Probe& probe : probes_) observables_.push_back({probe.name + ".pressure", dimension::pressure});
  for (const Section& section : sections_) {
    observables_.push_back({section.name() + ".flow", dimension::flow});
    observables_.push_back({section.name() + ".pressure", dimension::pressure});
  }
  observables_.push_back({"wall_shear", dimension::pressure});
  observables_.push_back({"volume", dimension::volume});
  observables_.push_back({"mass_balance_error", dimension::flow});
  observables_.push_back({"volume_balance_error", dimension::flow});
  observables_.push_back({"smallest_jacobian", dimension::none});
  observed_ = VectorXd::Zero(static_cast<Eigen::Index>(observables_.size()));
}

/// (F.17), on the mesh as the step has it.
void FluidSolver::observe_sections(std::vector<double>& values) const {
  if (sections_.empty()) return;
  const VectorXd& pressure = trial_.solution.pressure;
  const Points points = domain_.mesh().points + trial_.displacement;
  const EndOfStep end{domain_, points, trial_.velocity, pressure, trial_.dt / blood_->density, trial_.wall_velocity};
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    values.push_back(sections_[i].flow(trial_.cuts[i], end));
    values.push_back(Section::mean(trial_.cuts[i], domain_.mesh(), pressure));
  }
}

/// Flows are into the vessel at inlets, out of it at outlets, of the blood in space; where a flow is given, that flow.
/// (F.13)
void FluidSolver::observe() {
  const auto& solution = trial_.solution;
  std::vector<double> values;
  double net_inflow = trial_.inflow;
  for (const auto& inlet : flow_inlets_) {
    values.push_back(inlet.flow(trial_.end_time));
    values.push_back(inlet.face().mean(inlet.face().local(solution.pressure)));
  }
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    const auto& opening = openings_[i];
    const double outflow = solution.flow[static_cast<Eigen::Index>(i)];
    net_inflow -= outflow;
    values.push_back(opening.is_inlet() ? -outflow : outflow);
    values.push_back(opening.face().mean(opening.face().local(solution.pressure)));
    if (opening.beyond->stores()) values.push_back(opening.beyond->advanced(trial_.inputs[i], outflow));
  }
  for (const Probe& probe : probes_) values.push_back(probe.value(solution.pressure));
  observe_sections(values);
  trial_.volume = domain_.volume(trial_.interface_displacement);
  values.push_back(trial_.wall_shear);
  values.push_back(trial_.volume);
  values.push_back(net_inflow - trial_.interface_flux);
  values.push_back(net_inflow + trial_.swept - (trial_.volume - accepted_.volume) / trial_.dt);
  values.push_back(domain_.smallest_jacobian());
  observed_ = Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace tether::fluid
