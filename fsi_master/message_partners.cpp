#include "fsi_master/message_partners.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

using protocol::Partner;

/// Sends now; receives, and converts the reply, when it is got. A step that the partner cannot do becomes StepFailure.
template <class Request, class Convert>
auto ask_later(Partner& partner, const Request& request, Convert convert) {
  using Reply = typename Request::Reply;
  using Result = std::invoke_result_t<Convert, Reply>;
  partner.send(request);
  return Later<Result>(std::function<Result()>([&partner, convert] {
    try {
      return convert(partner.receive<Reply>());
    } catch (const protocol::PartnerFailed& failure) {
      throw StepFailure(failure.what());
    }
  }));
}

Done done(const protocol::Ready&) {
  return {};
}
std::vector<double> values_of(const VectorXd& v) {
  return {v.begin(), v.end()};
}
VectorXd vector_of(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

// What both partners are asked in the same words.

Later<std::vector<double>> ask_end_step(Partner& partner, bool accepted) {
  return ask_later(partner, protocol::EndStep{accepted}, [&partner, accepted](protocol::StepReport report) {
    const std::vector<protocol::ObservableInfo>& announced = partner.hello().observables;
    if (report.observables.size() != announced.size())
      throw run_error("{} reports {} observables after announcing {}", partner.role(), report.observables.size(),
                      announced.size());
    for (std::size_t i = 0; accepted && i < announced.size(); ++i)
      if (!std::isfinite(report.observables[i]))
        throw run_error("{} reports {} as {} after a step that was accepted", partner.role(), announced[i].name,
                        report.observables[i]);
    return std::move(report.observables);
  });
}

/// Throws RunError for one that cannot be set again: it would be saved, and be missed when the run is to go on.
Later<std::vector<double>> ask_state(Partner& partner) {
  return ask_later(partner, protocol::GetState{}, [&partner](protocol::State state) {
    const auto announced = static_cast<std::size_t>(partner.hello().state_size);
    if (state.values.size() != announced)
      throw run_error("{} gives a state of {} numbers after announcing {}", partner.role(), state.values.size(),
                      announced);
    if (!std::all_of(state.values.begin(), state.values.end(), [](double x) { return std::isfinite(x); }))
      throw run_error("{} gives a state with numbers that are not finite", partner.role());
    return std::move(state.values);
  });
}

Later<Done> tell_state(Partner& partner, std::vector<double> values) {
  return ask_later(partner, protocol::SetState{std::move(values)}, done);
}

Later<Done> tell_write(Partner& partner, std::int64_t step, double time) {
  return ask_later(partner, protocol::Write{step, time}, done);
}

Later<PartnerUsage> ask_usage(Partner& partner) {
  return ask_later(partner, protocol::GetUsage{}, [](const protocol::Usage& usage) {
    return PartnerUsage{usage.cpu_seconds, usage.peak_memory_mb};
  });
}

void check_size(const std::vector<double>& values, Eigen::Index size, const Partner& partner) {
  if (static_cast<Eigen::Index>(values.size()) != size)
    throw run_error("{} sent {} numbers where {} belong", partner.role(), values.size(), size);
}

protocol::Correct correction_of(const Innovation& data, double dt, bool drift) {
  return {dt, drift, values_of(data.weights), values_of(data.distances), values_of(data.normals)};
}

VectorXd sized(const std::vector<double>& values, Eigen::Index size, const Partner& partner) {
  check_size(values, size, partner);
  return vector_of(values);
}

constexpr double sizes_away = 10;  ///< of the interface: no wall moves so far

}  // namespace

Innovation at_nodes(const protocol::Discrepancy& samples, Eigen::Index nodes) {  // (O.5)
  Points normal = Points::Zero(3, nodes), direction = normal;
  Innovation data{VectorXd::Zero(nodes), VectorXd::Zero(nodes), {}};
  for (std::size_t s = 0; s < samples.weights.size(); ++s)
    for (std::size_t k = 3 * s; k < 3 * s + 3; ++k) {
      const double share = samples.weights[s] * samples.shares[k];
      const Eigen::Index node = samples.nodes[k];
      const Vec3 n(samples.normals[3 * s], samples.normals[3 * s + 1], samples.normals[3 * s + 2]);
      data.weights[node] += share;
      normal.col(node) += share * n;
      direction.col(node) += share * samples.distances[s] * n;
    }
  for (Eigen::Index node = 0; node < nodes; ++node) {
    if (data.weights[node] <= 0) continue;
    normal.col(node).normalize();
    data.distances[node] = direction.col(node).dot(normal.col(node)) / data.weights[node];
  }
  data.normals = normal.reshaped();
  return data;
}

// ---- fluid ----------------------------------------------------------------------------------------------------------

std::string MessageFluid::name() const {
  return "the fluid (" + partner_.hello().program + ")";
}
bool MessageFluid::has_tangent() const {
  return partner_.hello().has_tangent;
}
bool MessageFluid::has_state() const {
  return partner_.hello().has_state;
}

Later<Done> MessageFluid::begin_step(const StepStart& start) {
  return ask_later(partner_, protocol::BeginStep{start.step, start.time, start.dt, map_.to_fluid(start.predicted())},
                   done);
}
Later<std::vector<double>> MessageFluid::end_step(bool accepted) {
  return ask_end_step(partner_, accepted);
}
Later<std::vector<double>> MessageFluid::state() {
  return ask_state(partner_);
}
Later<Done> MessageFluid::set_state(std::vector<double> values) {
  return tell_state(partner_, std::move(values));
}
Later<Done> MessageFluid::write(std::int64_t step, double time) {
  return tell_write(partner_, step, time);
}
Later<PartnerUsage> MessageFluid::usage() {
  return ask_usage(partner_);
}

Later<VectorXd> MessageFluid::load(const Motion& motion) {
  const protocol::FluidEvaluate asked{map_.to_fluid(motion.displacement), map_.to_fluid(motion.velocity)};
  return ask_later(partner_, asked, [this, V = motion.velocity, there = asked.velocity](const protocol::Load& load) {
    VectorXd forces = received(load);
    if (!map_.is_node_for_node()) balance_.worst_of(map_.balance({load.forces, there}, {forces, V}));
    return forces;
  });
}

Later<VectorXd> MessageFluid::load_change(const VectorXd& velocity_change) {
  return ask_later(partner_, protocol::FluidTangent{map_.to_fluid(velocity_change)},
                   [this](const protocol::Load& load) { return received(load); });
}

bool MessageFluid::has_observer() const {
  return partner_.hello().has_observer;
}

Later<Done> MessageFluid::move_interface(const VectorXd& change) {
  return ask_later(partner_, protocol::MoveInterface{map_.to_fluid(change)}, done);
}

VectorXd MessageFluid::received(const protocol::Load& load) const {
  check_size(load.forces, 3 * map_.fluid_nodes(), partner_);
  return map_.to_solid(load.forces);
}

bool MessageFluid::has_velocity() const {
  return partner_.hello().has_velocity;
}

Later<Points> MessageFluid::velocity_at(const Points& points) {
  return ask_later(partner_, protocol::GetVelocity{{points.data(), points.data() + points.size()}},
                   [this, count = points.cols()](const protocol::Velocity& reply) -> Points {
                     check_size(reply.values, 3 * count, partner_);
                     return Eigen::Map<const Points>(reply.values.data(), 3, count);
                   });
}

// ---- solid ----------------------------------------------------------------------------------------------------------

std::string MessageSolid::name() const {
  return "the solid (" + partner_.hello().program + ")";
}
bool MessageSolid::has_tangent() const {
  return partner_.hello().has_tangent;
}
bool MessageSolid::has_operators() const {
  return partner_.hello().has_operators;
}
bool MessageSolid::has_state() const {
  return partner_.hello().has_state;
}

Later<Done> MessageSolid::begin_step(const StepStart& start) {
  return ask_later(partner_, protocol::BeginStep{start.step, start.time, start.dt, values_of(start.predicted())}, done);
}
Later<std::vector<double>> MessageSolid::end_step(bool accepted) {
  return ask_end_step(partner_, accepted);
}
Later<std::vector<double>> MessageSolid::state() {
  return ask_state(partner_);
}
Later<Done> MessageSolid::set_state(std::vector<double> values) {
  return tell_state(partner_, std::move(values));
}
Later<Done> MessageSolid::write(std::int64_t step, double time) {
  return tell_write(partner_, step, time);
}
Later<PartnerUsage> MessageSolid::usage() {
  return ask_usage(partner_);
}

/// Of the velocity, which the residual is made of, Convergence says whether it is finite.
VectorXd MessageSolid::displacement_of(const std::vector<double>& values, Eigen::Index size) const {
  VectorXd displacement = sized(values, size, partner_);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!std::isfinite(displacement[i]))
      throw StepFailure(fmt::format("{} answered with a displacement that is not finite, at interface node {}",
                                    partner_.role(), i / 3));
    if (std::abs(displacement[i]) > sizes_away * interface_size_)
      throw StepFailure(
          fmt::format("{} answered with a displacement of {:.3g} at interface node {}: more than {:g} "
                      "times the size of the interface, {:.3g}",
                      partner_.role(), displacement[i], i / 3, sizes_away, interface_size_));
  }
  return displacement;
}

Later<Motion> MessageSolid::motion(const VectorXd& load) {
  return ask_later(partner_, protocol::SolidEvaluate{values_of(load)},
                   [this, size = load.size()](const protocol::Motion& motion) {
                     return Motion{displacement_of(motion.displacement, size), sized(motion.velocity, size, partner_)};
                   });
}

Later<VectorXd> MessageSolid::velocity_change(const VectorXd& load_change) {
  return ask_later(partner_, protocol::SolidTangent{values_of(load_change)},
                   [this, size = load_change.size()](const protocol::Motion& motion) {
                     return sized(motion.velocity, size, partner_);
                   });
}

Later<SolidPartner::Iterate> MessageSolid::residual(const VectorXd& correction, const VectorXd& load) {
  return ask_later(partner_, protocol::SolidResidual{values_of(correction), values_of(load)},
                   [this, size = load.size()](const protocol::SolidResidualReply& reply) {
                     return Iterate{vector_of(reply.residual),
                                    {displacement_of(reply.displacement, size), sized(reply.velocity, size, partner_)}};
                   });
}

Later<VectorXd> MessageSolid::product(const VectorXd& direction) {
  return ask_later(
      partner_, protocol::SolidProduct{values_of(direction)},
      [this, size = direction.size()](const protocol::Unknowns& reply) { return sized(reply.values, size, partner_); });
}

Later<VectorXd> MessageSolid::precondition(const VectorXd& residual) {
  return ask_later(
      partner_, protocol::SolidPrecondition{values_of(residual)},
      [this, size = residual.size()](const protocol::Unknowns& reply) { return sized(reply.values, size, partner_); });
}

bool MessageSolid::has_observer() const {
  return partner_.hello().has_observer;
}

Later<VectorXd> MessageSolid::correct(double dt, const Innovation& data) {
  return ask_later(partner_, correction_of(data, dt, false),
                   [this, size = data.normals.size()](const protocol::Correction& reply) {
                     return sized(reply.displacement, size, partner_);
                   });
}

Later<VectorXd> MessageSolid::set_drift(const Innovation& data) {
  return ask_later(partner_, correction_of(data, 0, true),
                   [this, size = data.normals.size()](const protocol::Correction& reply) {
                     return sized(reply.displacement, size, partner_);
                   });
}

Later<Done> MessageSolid::withdraw(double share) {
  return ask_later(partner_, protocol::Withdraw{share}, done);
}

// ---- measurements ---------------------------------------------------------------------------------------------------

Later<Innovation> MessageObservation::observe(double time, const VectorXd& points) {
  return ask_later(partner_, protocol::Observe{time, values_of(points)},
                   [nodes = points.size() / 3](const protocol::Discrepancy& reply) { return at_nodes(reply, nodes); });
}

}  // namespace tether
