#include "fluid/server.hpp"

#include "common/base/error.hpp"
#include "common/protocol/announce.hpp"
#include "fluid/probe.hpp"

namespace tether::fluid {
namespace {

std::vector<double> as_list(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const auto flat = values.reshaped();
  return {flat.begin(), flat.end()};
}

}  // namespace

FluidServer::FluidServer(std::unique_ptr<FluidSolver> solver, const UnitSystem& units, std::string effective_case,
                         std::filesystem::path output, std::vector<std::string> notices)
    : solver_(std::move(solver)),
      units_(units),
      effective_case_(std::move(effective_case)),
      notices_(std::move(notices)),
      series_(std::move(output)) {}

protocol::Hello FluidServer::hello() const {
  protocol::Hello hello;
  hello.program = "Tether fluid";
  hello.has_tangent = hello.has_state = hello.has_observer = hello.has_velocity = true;
  hello.state_size = solver_->state_size();
  hello.unknowns = 4 * solver_->domain().node_count();
  hello.effective_case = effective_case_;
  hello.notices = notices_;
  for (const ParameterTable::Entry& entry : solver_->parameters().entries())
    hello.parameters.push_back(protocol::info_of(entry, units_));
  for (const auto& [name, dimension] : solver_->observables())
    hello.observables.push_back({name, units_.symbol(dimension)});
  return hello;
}

protocol::Interface FluidServer::operator()(const protocol::GetInterface&) {
  const Surface& sigma = solver_->domain().sigma;
  protocol::Interface reply{as_list(sigma.local(solver_->domain().mesh().points)), {}, {}, {}};
  for (const Triangle& triangle : sigma.triangles)
    reply.triangles.insert(reply.triangles.end(), triangle.begin(), triangle.end());
  return reply;
}

protocol::Ready FluidServer::operator()(const protocol::SetParameters& m) {
  solver_->set_parameters(m.names, m.values);
  return {};
}

protocol::State FluidServer::operator()(const protocol::GetState&) {
  solver_->forget_earlier_meshes();
  return {as_list(solver_->state())};
}

protocol::Ready FluidServer::operator()(const protocol::SetState& m) {
  solver_->set_state(Eigen::Map<const VectorXd>(m.values.data(), static_cast<Eigen::Index>(m.values.size())));
  return {};
}

protocol::Ready FluidServer::operator()(const protocol::BeginStep& m) {
  solver_->begin_step(m.time, m.dt, interface_points(m.predicted, "predicted displacement"));
  return {};
}

protocol::StepReport FluidServer::operator()(const protocol::EndStep& m) {
  if (m.accepted)
    solver_->accept();
  else
    solver_->rewind();
  return {as_list(solver_->observed())};
}

protocol::Ready FluidServer::operator()(const protocol::Write& m) {
  if (solver_->domain().share().team().rank() == 0) series_.write(*solver_, static_cast<int>(m.step), m.time);
  return {};
}

protocol::Load FluidServer::operator()(const protocol::FluidEvaluate& m) {
  return {as_list(
      solver_->evaluate(interface_points(m.displacement, "displacement"), interface_points(m.velocity, "velocity")))};
}

protocol::Load FluidServer::operator()(const protocol::FluidTangent& m) {
  return {as_list(solver_->tangent(interface_points(m.velocity_change, "change of velocity")))};
}

protocol::Ready FluidServer::operator()(const protocol::MoveInterface& m) {
  solver_->move_interface(interface_points(m.displacement, "change of the displacement"));
  return {};
}

protocol::Velocity FluidServer::operator()(const protocol::GetVelocity& m) {
  if (m.points.size() % 3 != 0) throw run_error("points have {} numbers, not three each", m.points.size());
  const Points now = solver_->domain().mesh().points + solver_->mesh_displacement(),
               places = Eigen::Map<const Points>(m.points.data(), 3, static_cast<Eigen::Index>(m.points.size() / 3));
  return {as_list(vectors_in_space(places, now, solver_->domain().mesh().tetrahedra, solver_->velocity()))};
}

Points FluidServer::interface_points(const std::vector<double>& values, const char* what) const {
  const std::size_t nodes = solver_->domain().sigma.nodes.size();
  if (values.size() != 3 * nodes)
    throw run_error("a {} has {} numbers; {} interface nodes need {}", what, values.size(), nodes, 3 * nodes);
  return Eigen::Map<const Points>(values.data(), 3, static_cast<Eigen::Index>(nodes));
}

}  // namespace tether::fluid
