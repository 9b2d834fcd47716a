#include "fluid/fluid_solver.hpp"

#include "common/base/error.hpp"

namespace tether::fluid {
namespace {

std::vector<std::vector<int>> nodes_of_openings(const std::vector<Opening>& openings) {
  std::vector<std::vector<int>> result;
  for (const auto& opening : openings) result.push_back(opening.face().nodes);
  return result;
}

std::vector<const Surface*> faces_of(const std::vector<Opening>& openings) {
  std::vector<const Surface*> result;
  for (const auto& opening : openings) result.push_back(&opening.face());
  return result;
}

std::vector<FlowInlet> make_flow_inlets(const FluidDomain& domain, const FluidSettings& settings) {
  std::vector<FlowInlet> result;
  for (const auto& face : domain.inlets) {
    const auto found = settings.inlets.find(face.name);
    if (found == settings.inlets.end())
      throw input_error("nothing is said about inlet \"{}\" of the fluid mesh", face.name);
    if (found->second.effect.type != "pressure") result.emplace_back(face, found->second);
  }
  return result;
}

std::vector<Opening> make_openings(const FluidDomain& domain, const FluidSettings& settings) {
  std::vector<Opening> result;
  for (const auto& face : domain.inlets)
    if (const auto& inlet = settings.inlets.at(face.name); inlet.effect.type == "pressure")
      result.emplace_back(face, inlet.effect, inlet.curve, true);
  for (const auto& face : domain.outlets) {
    const auto found = settings.outlets.find(face.name);
    if (found == settings.outlets.end())
      throw input_error("nothing is said about outlet \"{}\" of the fluid mesh", face.name);
    result.emplace_back(face, found->second.effect, found->second.curve, false);
  }
  return result;
}

std::vector<Probe> make_probes(const FluidMesh& mesh, const FluidSettings& settings) {
  std::vector<Probe> result;
  for (const auto& [name, position] : settings.probes) result.push_back(place_probe(name, position, mesh));
  return result;
}

std::vector<Section> make_sections(const FluidMesh& mesh, const FluidSettings& settings) {
  std::vector<Section> result;
  for (const auto& [name, plane] : settings.sections) result.push_back(place_section(name, plane, mesh));
  return result;
}

template <class Settings>
void check_faces_exist(const std::map<std::string, Settings>& named, const std::vector<EndFace>& faces,
                       const char* kind) {
  for (const auto& [name, unused] : named)
    if (std::none_of(faces.begin(), faces.end(), [&name = name](const EndFace& face) { return face.name == name; }))
      throw input_error("the fluid mesh has no {} \"{}\"", kind, name);
}

/// Nodes where the velocity is prescribed: Sigma and the inlets through which the flow is given.
std::vector<int> fixed_nodes(const FluidDomain& domain, const std::vector<FlowInlet>& inlets) {
  std::vector<int> result = domain.sigma.nodes;
  for (const auto& inlet : inlets)
    for (int local : inlet.face().inner) result.push_back(inlet.face().nodes[static_cast<std::size_t>(local)]);
  std::sort(result.begin(), result.end());
  return result;
}

/// A shear rate of flowing blood, at which the profile of an inlet takes its one viscosity [1/s].
constexpr double typical_shear_rate = 100;

}  // namespace

FluidSolver::FluidSolver(FluidMesh mesh, const FluidSettings& settings, Team& team)
    : domain_(std::move(mesh), settings.mesh_motion, team),
      blood_(blood(), settings.blood),
      rheology_(rheologies(), settings.rheology),
      flow_inlets_(make_flow_inlets(domain_, settings)),
      openings_(make_openings(domain_, settings)),
      open_faces_(faces_of(openings_)),
      probes_(make_probes(domain_.mesh(), settings)),
      sections_(make_sections(domain_.mesh(), settings)),
      body_acceleration_(settings.body_acceleration),
      linear_tolerance_(settings.linear_tolerance),
      advection_diffusion_(domain_, fixed_nodes(domain_, flow_inlets_)),
      projection_(domain_, nodes_of_openings(openings_)) {
  check_faces_exist(settings.inlets, domain_.inlets, "inlet");
  check_faces_exist(settings.outlets, domain_.outlets, "outlet");
  declare_parameters();
  declare_observables();
  accepted_.velocity = Points::Zero(3, domain_.node_count());
  accepted_.pressure = VectorXd::Zero(domain_.node_count());
  accepted_.on_sigma = Points::Zero(3, static_cast<Eigen::Index>(domain_.sigma.nodes.size()));
  accepted_.volume = domain_.volume(accepted_.on_sigma);
  store_initial_pressures();
  derive(accepted_);
  nodes_ = Mark().add(domain_.mesh().points.reshaped());
  beyond_ = mark_of_openings();
}

void FluidSolver::begin_step(double time, double dt, const Points& predicted) {
  TETHER_ASSERT(predicted.cols() == accepted_.on_sigma.cols(), "{} of {} interface nodes", predicted.cols(),
                accepted_.on_sigma.cols());
  TETHER_ASSERT(dt > 0, "dt = {}", dt);
  begun_ = evaluated_ = false;
  trial_.dt = dt;
  trial_.end_time = time + dt;
  trial_.on_sigma = predicted;
  move_mesh();
  cut_sections();
  predict_velocity();
  prepare_projection();
  const Points forces = viscous_forces();
  trial_.viscous_load = domain_.sigma.shared_by_nodes(forces);
  trial_.wall_shear = domain_.sigma.mean_shear(forces);
  begun_ = true;
}

/// (F.1), (F.2)
void FluidSolver::move_mesh() {
  trial_.displacement = domain_.extend(trial_.on_sigma);
  trial_.mesh_velocity = (trial_.displacement - accepted_.displacement) / trial_.dt;
  domain_.place(trial_.displacement);
}

/// Before anything is computed: a section that the vessel has left fails the step, which is not accepted yet. (F.17)
void FluidSolver::cut_sections() {
  trial_.cuts.clear();
  if (sections_.empty()) return;
  const FluidMesh& mesh = domain_.mesh();
  const Points points = mesh.points + trial_.displacement;
  for (const Section& section : sections_) try {
      trial_.cuts.push_back(section.cut(mesh, points));
    } catch (const InputError& error) {
      throw run_error("the blood has moved away from the section {}: {}", section.name(), error.what());
    }
}

/// (F.4), (F.12)
void FluidSolver::predict_velocity() {
  trial_.velocity = accepted_.velocity;
  trial_.velocity(Eigen::all, domain_.sigma.nodes) = trial_.mesh_velocity(Eigen::all, domain_.sigma.nodes);
  trial_.inflow = 0;
  trial_.profiles.clear();
  for (auto& inlet : flow_inlets_) {
    const auto& face = inlet.face();
    trial_.profiles.push_back(inlet.velocity(trial_.end_time, kinematic_viscosity(), face.local(trial_.mesh_velocity)));
    trial_.inflow -= face.total_flux(trial_.profiles.back());
    for (int local : face.inner)
      trial_.velocity.col(face.nodes[static_cast<std::size_t>(local)]) = trial_.profiles.back().col(local);
  }
  const Points force = acceleration();
  const StageInput input{blood_->density,    trial_.dt,         blood_->backflow_stabilisation, *rheology_,
                         accepted_.velocity, accepted_.carried, trial_.mesh_velocity,           force,
                         open_faces_};
  const KrylovResult result = advection_diffusion_.solve(domain_, input, linear_tolerance_, trial_.velocity);
  if (!result.converged)
    throw run_error(
        "the advection-diffusion solve of the fluid stops at a relative residual of {:.2g} after {} iterations",
        result.residual, result.iterations);
}

/// (F.8), (F.9): the matrix, and of the right-hand side (v~, grad q) - <u_in.n, q>.
void FluidSolver::prepare_projection() {
  trial_.rhs = VectorXd::Zero(domain_.node_count());
  for (std::size_t e = 0; e < domain_.tetrahedra().size(); ++e) {
    const auto& tet = domain_.tetrahedra()[e];
    const TetGeometry& g = domain_.geometry()[e];
    const Vec3 integral = gather(trial_.velocity, tet).rowwise().sum() * (g.volume / 4);
    const Eigen::Vector4d shares = g.grad_N.transpose() * integral;
    for (int a = 0; a < 4; ++a) trial_.rhs[tet[static_cast<std::size_t>(a)]] += shares[a];
  }
  trial_.swept = 0;
  for (std::size_t i = 0; i < flow_inlets_.size(); ++i) {
    const auto& face = flow_inlets_[i].face();
    trial_.rhs(face.nodes) -= face.flux(trial_.profiles[i]);
    trial_.swept += face.total_flux(face.local(trial_.mesh_velocity));
  }
  std::vector<double> impedances;
  trial_.known.resize(static_cast<Eigen::Index>(openings_.size()));
  trial_.inputs.clear();
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    const auto& opening = openings_[i];
    trial_.swept += opening.face().total_flux(opening.face().local(trial_.mesh_velocity));
    trial_.inputs.push_back(opening.input(trial_.end_time, trial_.dt, accepted_.stored[static_cast<Eigen::Index>(i)]));
    trial_.known[static_cast<Eigen::Index>(i)] = opening.beyond->known(trial_.inputs.back());
    impedances.push_back(opening.beyond->impedance(trial_.dt));
  }
  projection_.factor(domain_, trial_.dt / blood_->density, impedances);
}

Points FluidSolver::evaluate(const Points& displacement, const Points& velocity) {
  TETHER_ASSERT(begun_, "evaluate without begin_step");
  Surface& sigma = domain_.sigma;
  trial_.wall_points = sigma.local(domain_.mesh().points) + displacement - trial_.dt / 2 * velocity;
  trial_.wall_velocity = velocity;
  sigma.place_locally(trial_.wall_points);
  const VectorXd through = sigma.flux(velocity);
  VectorXd rhs = trial_.rhs;
  rhs(sigma.nodes) -= through;
  trial_.solution = projection_.solve(rhs, trial_.known);
  trial_.interface_displacement = displacement;
  trial_.interface_flux = through.sum();
  evaluated_ = true;
  trial_.wall_pressure = sigma.local(trial_.solution.pressure).array() + blood_->wall_load_offset;
  return sigma.pressure_force(trial_.wall_pressure) + trial_.viscous_load;  // (F.10)
}

Points FluidSolver::tangent(const Points& velocity_change) const {
  TETHER_ASSERT(evaluated_, "tangent without evaluate");
  const Surface& sigma = domain_.sigma;
  const Points motion = trial_.dt / 2 * velocity_change;
  VectorXd rhs = VectorXd::Zero(domain_.node_count());
  rhs(sigma.nodes) = -sigma.flux(velocity_change) - sigma.flux_change(trial_.wall_velocity, trial_.wall_points, motion);
  const auto change = projection_.solve(rhs, VectorXd::Zero(trial_.known.size()));
  return sigma.pressure_force(sigma.local(change.pressure)) +  // (F.11)
         sigma.pressure_force_change(trial_.wall_pressure, trial_.wall_points, motion);
}

void FluidSolver::accept() {
  TETHER_ASSERT(evaluated_, "accept without evaluate");
  observe();
  accepted_.velocity = trial_.velocity;
  accepted_.pressure = trial_.solution.pressure;
  accepted_.on_sigma = trial_.on_sigma;
  accepted_.displacement = trial_.displacement;
  accepted_.impulse = trial_.dt / blood_->density;
  accepted_.volume = trial_.volume;
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    accepted_.stored[index] = openings_[i].beyond->advanced(trial_.inputs[i], trial_.solution.flow[index]);
  }
  accepted_.carried = accepted_.impulse * gradient(domain_.geometry(), domain_.tetrahedra(), accepted_.pressure);
  begun_ = evaluated_ = false;
}

/// - int 2 mu eps(v~) n phi_a on the interface: of each triangle by the process that answers for the element behind it.
/// (F.10)
Points FluidSolver::viscous_forces() const {
  const Surface& sigma = domain_.sigma;
  const Share& share = domain_.share();
  Points result = Points::Zero(3, static_cast<Eigen::Index>(sigma.triangles.size()));
  for (std::size_t t = 0; t < sigma.triangles.size(); ++t) {
    const int element = sigma.tetrahedra[t];
    if (!share.answers_for(domain_.mesh().tetrahedra[static_cast<std::size_t>(element)])) continue;
    const auto e = static_cast<std::size_t>(domain_.place_of(element));
    const Mat3 grad_v = velocity_gradient(domain_.geometry()[e], gather(trial_.velocity, domain_.tetrahedra()[e]));
    const double mu = advection_diffusion_.viscosity()[static_cast<Eigen::Index>(e)];
    const auto triangle = static_cast<Eigen::Index>(t);
    result.col(triangle) = -mu * (grad_v + grad_v.transpose()) * sigma.area_vectors.col(triangle);
  }
  share.team().sum({result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

Points FluidSolver::acceleration() const {
  if (!body_acceleration_) return {};
  const Points points = domain_.mesh().points + trial_.displacement;
  Points result(3, points.cols());
  for (Eigen::Index node = 0; node < points.cols(); ++node)
    result.col(node) = body_acceleration_(points.col(node), trial_.end_time);
  return result;
}

double FluidSolver::kinematic_viscosity() const {
  return rheology_->viscosity(typical_shear_rate) / blood_->density;
}

}  // namespace tether::fluid
