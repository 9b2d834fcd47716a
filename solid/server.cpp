#include "solid/server.hpp"

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/announce.hpp"
#include "solid/lumen_regions.hpp"
#include "solid/wall_series.hpp"
#include "solid/wall_stress.hpp"

namespace tether {
namespace {

std::vector<double> as_list(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const auto flat = values.reshaped();
  return {flat.begin(), flat.end()};
}

Eigen::Map<const VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

protocol::Motion as_message(const InterfaceMotion& motion) {
  return {as_list(motion.displacement), as_list(motion.velocity)};
}

}  // namespace

SolidServer::SolidServer(PreparedWall wall, const UnitSystem& units, std::string effective_case,
                         std::filesystem::path output)
    : model_(std::move(wall.model)),
      solver_(std::make_unique<SolidSolver>(*model_)),
      units_(units),
      effective_case_(std::move(effective_case)),
      notices_(std::move(wall.notices)),
      rest_(std::move(wall.rest)),
      output_(std::move(output)),
      series_(std::make_unique<WallSeries>(output_)) {
  if (wall.observer_gain.size() > 0) observer_ = std::make_unique<StateObserver>(*model_, wall.observer_gain);
}

SolidServer::SolidServer(SolidServer&&) noexcept = default;
SolidServer::~SolidServer() = default;

protocol::Hello SolidServer::hello() const {
  protocol::Hello hello;
  hello.program = "Tether solid";
  hello.has_tangent = hello.has_operators = hello.has_state = true;
  hello.has_observer = observer_ != nullptr;
  hello.state_size = solver_->state_size() + (observer_ ? observer_->state_size() : 0);
  hello.unknowns = model_->unknowns();
  hello.effective_case = effective_case_;
  hello.notices = notices_;
  for (const ParameterTable::Entry& entry : model_->parameters().entries())
    hello.parameters.push_back(protocol::info_of(entry, units_));
  hello.observables.push_back({"largest_displacement", units_.symbol(dimension::length)});
  hello.observables.push_back({"peak_stress", units_.symbol(dimension::pressure)});
  for (const SurfaceSupport& support : model_->supports())
    for (const char* axis : {"x", "y", "z"})
      hello.observables.push_back(
          {(support.path().empty() ? "support." : "effect.") + support.name() + ".force_" + axis,
           units_.symbol(dimension::force)});
  return hello;
}

protocol::Interface SolidServer::operator()(const protocol::GetInterface&) {
  const WallMesh& mesh = model_->mesh();
  protocol::Interface reply{as_list(mesh.points.leftCols(mesh.interface_nodes)), {}, {}, {}};
  for (const Triangle& triangle : mesh.interface)
    reply.triangles.insert(reply.triangles.end(), triangle.begin(), triangle.end());
  for (const Patch& region : mesh.outside) reply.region_names.push_back(region.name);
  for (int region : regions_of_interface(mesh)) reply.regions.push_back(region);
  return reply;
}

protocol::Ready SolidServer::operator()(const protocol::SetParameters& m) {
  model_->parameters().set(m.names, m.values);
  return {};
}

protocol::State SolidServer::operator()(const protocol::GetState&) {
  protocol::State state{as_list(solver_->state())};
  if (observer_) {
    const VectorXd more = observer_->state();
    state.values.insert(state.values.end(), more.begin(), more.end());
  }
  return state;
}

protocol::Ready SolidServer::operator()(const protocol::SetState& m) {
  const VectorXd values = as_vector(m.values);
  const Eigen::Index more = observer_ ? observer_->state_size() : 0;
  const bool is_whole = values.size() == solver_->state_size() + more;  // another run may have had no observer
  solver_->set_state(is_whole ? values.head(solver_->state_size()) : values);
  if (observer_ && is_whole) observer_->set_state(values.tail(more));
  return {};
}

protocol::Ready SolidServer::operator()(const protocol::BeginStep& m) {
  solver_->begin_step(m.time, m.dt);
  dt_ = m.dt;
  return {};
}

protocol::StepReport SolidServer::operator()(const protocol::EndStep& m) {
  if (m.accepted)
    solver_->accept();
  else
    solver_->rewind();
  protocol::StepReport report{
      {solver_->largest_displacement(),
       peak_stress(model_->elements(), model_->material(), model_->mesh().points + solver_->displacement())}};
  for (const Vec3& force : solver_->support_forces())
    report.observables.insert(report.observables.end(), force.begin(), force.end());
  return report;
}

protocol::Ready SolidServer::operator()(const protocol::Write& m) {
  const auto stress =
      model_->elements().cauchy_stress(model_->mesh().points + solver_->displacement(), model_->material());
  if (model_->share().team().rank() != 0) return {};
  const auto rest = output_ / "rest.json";
  // A run that goes on may lack it, or find one that was changed.
  if (m.step == 0 || !rest_is_written_ || !std::filesystem::exists(rest)) write_record(rest, rest_);
  rest_is_written_ = true;
  series_->write(*model_, *solver_, stress, static_cast<int>(m.step), m.time);
  return {};
}

protocol::Ready SolidServer::operator()(const protocol::Stop&) {
  return {};
}

protocol::Motion SolidServer::operator()(const protocol::SolidEvaluate& m) {
  return as_message(solver_->evaluate(interface_points(m.load, "load")));
}

protocol::Motion SolidServer::operator()(const protocol::SolidTangent& m) {
  return as_message(solver_->tangent(interface_points(m.load_change, "change of load")));
}

protocol::SolidResidualReply SolidServer::operator()(const protocol::SolidResidual& m) {
  const VectorXd residual = solver_->residual(as_vector(m.correction), interface_points(m.load, "load"));
  const protocol::Motion motion = as_message(solver_->interface_motion());
  return {as_list(residual), motion.displacement, motion.velocity};
}

protocol::Unknowns SolidServer::operator()(const protocol::SolidProduct& m) {
  return {as_list(solver_->product(as_vector(m.direction)))};
}

protocol::Unknowns SolidServer::operator()(const protocol::SolidPrecondition& m) {
  return {as_list(solver_->precondition(as_vector(m.residual)))};
}

protocol::Correction SolidServer::operator()(const protocol::Correct& m) {
  if (!observer_) throw run_error("the case has no state observer");
  if (m.drift && !(dt_ > 0)) throw run_error("a drift belongs to a step, and none has begun");
  const NodalDistances data = distances_of(m);
  const Points change = m.drift ? observer_->drift(data, dt_) : observer_->correction(data, m.dt);
  if (m.drift) {
    solver_->set_drift(change);
  } else {
    solver_->displace(change);
    corrected_ = change;
  }
  return {as_list(change.leftCols(model_->mesh().interface_nodes))};
}

protocol::Ready SolidServer::operator()(const protocol::Withdraw& m) {
  if (corrected_.size() == 0) throw run_error("there is no correction to take back");
  const Points back = -m.share * corrected_;
  solver_->displace(back);
  corrected_ += back;
  return {};
}

NodalDistances SolidServer::distances_of(const protocol::Correct& m) const {
  const int nodes = model_->mesh().interface_nodes;
  if (m.weights.size() != static_cast<std::size_t>(nodes) || m.distances.size() != m.weights.size())
    throw run_error("{} weights and {} distances for {} interface nodes", m.weights.size(), m.distances.size(), nodes);
  return {as_vector(m.weights), as_vector(m.distances), interface_points(m.normals, "normals")};
}

Points SolidServer::interface_points(const std::vector<double>& values, const char* what) const {
  const int nodes = model_->mesh().interface_nodes;
  if (values.size() != 3 * static_cast<std::size_t>(nodes))
    throw run_error("a {} has {} numbers; {} interface nodes need {}", what, values.size(), nodes, 3 * nodes);
  return Eigen::Map<const Points>(values.data(), 3, nodes);
}

}  // namespace tether
