#include "solid/server.hpp"

#include "common/base/error.hpp"
#include "common/mesh/locator.hpp"
#include "solid/wall_series.hpp"

namespace tether {
namespace {

std::vector<double> as_list(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const auto flat = values.reshaped();
  return {flat.begin(), flat.end()};
}

Eigen::Map<const VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Vec3 centre_of(const Points& x, const Triangle& t) {
  return (x.col(t[0]) + x.col(t[1]) + x.col(t[2])) / 3;
}

/// Region of each triangle of the interface: that of the nearest triangle of the outer wall.
std::vector<int> regions_inside(const WallMesh& mesh) {
  std::vector<int> region_of;
  std::vector<Vec3> centres;
  for (std::size_t region = 0; region < mesh.outside.size(); ++region)
    for (const Triangle& t : mesh.outside[region].triangles) {
      region_of.push_back(static_cast<int>(region));
      centres.push_back(centre_of(mesh.points, t));
    }
  const PointLocator locator(
      Eigen::Map<const Points>(centres.front().data(), 3, static_cast<Eigen::Index>(centres.size())));
  std::vector<int> result;
  for (const Triangle& t : mesh.interface)
    result.push_back(region_of[static_cast<std::size_t>(locator.nearest(centre_of(mesh.points, t)).node)]);
  return result;
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
      series_(std::make_unique<WallSeries>(std::move(output))) {}

SolidServer::SolidServer(SolidServer&&) noexcept = default;
SolidServer::~SolidServer() = default;

protocol::Hello SolidServer::hello() const {
  protocol::Hello hello;
  hello.program = "Tether solid";
  hello.has_tangent = hello.has_operators = hello.has_state = true;
  hello.state_size = solver_->state_size();
  hello.unknowns = model_->unknowns();
  hello.effective_case = effective_case_;
  hello.notices = notices_;
  for (const auto& [name, p, value, set] : model_->parameters().entries())
    hello.parameters.push_back({name, p.meaning, units_.symbol(p.dimension), name_of(p.transform), value(), p.absent,
                                p.range.lower, p.range.upper, p.prior_deviation});
  hello.observables.push_back({"largest_displacement", units_.symbol(dimension::length)});
  for (const SurfaceSupport& support : model_->supports())
    for (const char* axis : {"x", "y", "z"})
      hello.observables.push_back({"support." + support.name() + ".force_" + axis, units_.symbol(dimension::force)});
  return hello;
}

protocol::Interface SolidServer::operator()(const protocol::GetInterface&) {
  const WallMesh& mesh = model_->mesh();
  protocol::Interface reply{as_list(mesh.points.leftCols(mesh.interface_nodes)), {}, {}, {}};
  for (const Triangle& triangle : mesh.interface)
    reply.triangles.insert(reply.triangles.end(), triangle.begin(), triangle.end());
  for (const Patch& region : mesh.outside) reply.region_names.push_back(region.name);
  for (int region : regions_inside(mesh)) reply.regions.push_back(region);
  return reply;
}

protocol::Ready SolidServer::operator()(const protocol::SetParameters& m) {
  if (m.names.size() != m.values.size())
    throw input_error("{} names of parameters, but {} values", m.names.size(), m.values.size());
  for (std::size_t i = 0; i < m.names.size(); ++i) model_->parameters().set(m.names[i], m.values[i]);
  return {};
}

protocol::State SolidServer::operator()(const protocol::GetState&) {
  return {as_list(solver_->state())};
}

protocol::Ready SolidServer::operator()(const protocol::SetState& m) {
  solver_->set_state(as_vector(m.values));
  return {};
}

protocol::Ready SolidServer::operator()(const protocol::BeginStep& m) {
  solver_->begin_step(m.time, m.dt);
  return {};
}

protocol::StepReport SolidServer::operator()(const protocol::EndStep& m) {
  if (m.accepted)
    solver_->accept();
  else
    solver_->rewind();
  protocol::StepReport report{{solver_->largest_displacement()}};
  for (const Vec3& force : solver_->support_forces())
    report.observables.insert(report.observables.end(), force.begin(), force.end());
  return report;
}

protocol::Ready SolidServer::operator()(const protocol::Write& m) {
  series_->write(*model_, *solver_, static_cast<int>(m.step), m.time);
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

Points SolidServer::interface_points(const std::vector<double>& values, const char* what) const {
  const int nodes = model_->mesh().interface_nodes;
  if (values.size() != 3 * static_cast<std::size_t>(nodes))
    throw run_error("a {} has {} numbers; {} interface nodes need {}", what, values.size(), nodes, 3 * nodes);
  return Eigen::Map<const Points>(values.data(), 3, nodes);
}

}  // namespace tether
