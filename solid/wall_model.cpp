#include "solid/wall_model.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "solid/element_places.hpp"
#include "solid/materials/registry.hpp"
#include "solid/vessel_direction.hpp"
#include "solid/wall_share.hpp"

namespace tether {

std::vector<int> unknowns_of(const std::vector<int>& nodes) {
  std::vector<int> result;
  for (int node : nodes)
    for (int component = 0; component < 3; ++component) result.push_back(3 * node + component);
  return result;
}

WallModel::WallModel(WallMesh mesh, const WallSettings& settings, const Points& stress_free,
                     std::vector<int> clamped_nodes, std::vector<SurfaceSupport> supports,
                     std::vector<LocalEffect> effects, Team& team)
    : mesh_(std::move(mesh)),
      share_(wall_share(mesh_, team)),
      settings_(settings),
      material_(materials(), settings.material, settings.material_values),
      elements_(make_wall_elements(mesh_, stress_free, share_)),
      supports_(std::move(supports)),
      effects_(std::move(effects)),
      always_clamped_(unknowns_of(clamped_nodes)) {
  if (settings.conserve_energy && settings.theta != 0.5)
    throw input_error("solid.theta: {} with integrator energy_conserving: must be 0.5", settings.theta);
  for (SurfaceSupport& support : supports_) support.share_out(share_);
  orient_supports();
  for (SurfaceSupport& support : supports_) support.place(mesh_.points);
  attach_present();
  declare_parameters();
  update_clamps();
  if (!effects_.empty()) place_effects();
}

void WallModel::attach_present() {
  std::optional<SparseMatrix> pattern;
  for (SurfaceSupport& support : supports_) {
    if (support.is_attached() || support.effect().is_absent()) continue;
    if (!pattern) pattern = elements_->zero_matrix();
    support.attach(*pattern);
  }
}

void WallModel::place_effects() {
  const bool oriented = std::any_of(effects_.begin(), effects_.end(), [](const LocalEffect& local) {
    return local.effect->uses_axial() || !local.extent.is_all_along();
  });
  const VectorXd along = oriented ? place_along_vessel(mesh_) : VectorXd();
  zones_ = wall_zones(mesh_, effects_, along);
  std::vector<Patch> patches;
  for (const WallZone& zone : zones_) patches.push_back(zone.patch);
  ElementPlaces places = element_places(mesh_, patches, along);
  elements_->set_places(std::move(places.of_elements));
  mixtures_ = std::move(places.mixtures);
  update_effects();
}

void WallModel::update_effects() {
  std::vector<WallLocal> zones(zones_.size());
  for (const LocalEffect& local : effects_)
    for (std::size_t z = 0; z < zones.size(); ++z)
      if (acts_in(local, zones_[z])) local.effect->apply(zones[z]);
  const std::vector<WallLocal> pure = zones;
  for (const std::vector<double>& shares : mixtures_) zones.push_back(mixture(pure, shares));
  const bool tense = std::any_of(zones.begin(), zones.end(), [](const WallLocal& l) { return l.tension != 0; });
  elements_->set_local(std::move(zones));
  tension_held_ = tense ? elements_->tension_force(mesh_.points) : VectorXd();
}

void WallModel::orient_supports() {
  std::shared_ptr<const VectorXd> along;
  for (SurfaceSupport& support : supports_) {
    if (!support.effect()->uses_axial()) continue;
    if (!along) along = std::make_shared<const VectorXd>(place_along_vessel(mesh_));
    support.orient(along);
  }
}

void WallModel::update_clamps() {
  clamped_ = always_clamped_;
  driven_ = rings_;
  for (const SurfaceSupport& support : supports_) {
    if (!replaces_clamp(support.effect().declaration())) continue;
    const std::vector<int> nodes = nodes_of(support.triangles());
    if (support.effect().is_absent()) {
      const std::vector<int> more = unknowns_of(nodes);
      clamped_.insert(clamped_.end(), more.begin(), more.end());
    } else {
      std::erase_if(driven_, [&](const DrivenRing& ring) { return ring.nodes == nodes; });
    }
  }
  std::erase_if(driven_, [](const DrivenRing& ring) { return !ring.anchor.moves(); });
}

void WallModel::drive(std::vector<DrivenRing> rings) {
  rings_ = std::move(rings);
  for (const DrivenRing& ring : rings_)
    for (const auto& tissue : ring.anchor.tissues) declare_tissue(*tissue);
  update_clamps();
}

void WallModel::declare_parameters() {
  const Parameter density{.name = "density",
                          .meaning = "density of the wall",
                          .dimension = dimension::density,
                          .range = range::positive,
                          .standard = undefined,
                          .absent = undefined,
                          .transform = Transform::log2,
                          .prior_deviation = 0.2};
  // In 15 human aortas (Circulation Research 66:1413, 1990) the diameter lags the pressure by 6.7 degrees at 1.2 Hz, as
  // with a viscosity of tan(6.7 deg) / (2 pi 1.2 Hz) = 16 ms times the modulus. That is 6e5 Pa where a pressure-strain
  // modulus of 1.52e5 Pa, theirs, is that of a wall of a quarter of the radius.
  constexpr double viscosity_in_patients = 1e4;
  const Parameter viscosity{.name = "viscosity",
                            .meaning = "viscosity of the wall: stress per rate of Green-Lagrange strain",
                            .dimension = dimension::viscosity,
                            .range = range::not_negative,
                            .standard = 0.0,
                            .absent = 0.0,
                            .transform = Transform::log2,
                            .prior_deviation = 1.0,
                            .scale = viscosity_in_patients};
  parameters_.add(
      {"solid.density", density, [this] { return settings_.density; }, [this](double v) { settings_.density = v; }});
  parameters_.add({"solid.viscosity", viscosity, [this] { return settings_.viscosity; },
                   [this](double v) { settings_.viscosity = v; }});
  parameters_.add_effect("solid.material", material_);
  declare_supports();
  for (LocalEffect& local : effects_) parameters_.add_effect(local.path, local.effect, [this] { update_effects(); });
}

void WallModel::declare_supports() {
  for (SurfaceSupport& support : supports_) {
    parameters_.add_effect(path_of(support), support.effect(), [this] {
      attach_present();
      update_clamps();
    });
    for (const auto& tissue : support.tissues()) declare_tissue(*tissue);
  }
}

/// Several parts of the wall may be tied to the same tissue.
void WallModel::declare_tissue(MovingTissue& tissue) {
  if (std::find(tissues_.begin(), tissues_.end(), &tissue) != tissues_.end()) return;
  tissues_.push_back(&tissue);
  parameters_.add_effect(tissue.path, tissue.motion, [this] { update_clamps(); });
}

std::string WallModel::path_of(const SurfaceSupport& support) const {
  if (!support.path().empty()) return support.path();
  const bool ring =
      std::any_of(mesh_.rings.begin(), mesh_.rings.end(), [&](const Patch& p) { return p.name == support.name(); });
  return (ring ? "solid.rings." : "solid.support.regions.") + support.name();
}

void WallModel::set_initial_stress(const InitialStress& initial) {
  elements_->set_initial_stress(initial.virtual_displacement, *material_);
  held_ = initial.held.reshaped();
}

void WallModel::place_supports(const Points& displacement) {
  if (!settings_.support_on_current_area) return;
  const Points positions = mesh_.points + displacement;
  for (SurfaceSupport& support : supports_)
    if (!support.effect().is_absent()) support.place(positions);
}

VectorXd WallModel::step_forces(const Points& displacement, const Points& start_velocity, const Points& velocity,
                                double time, double dt, SparseMatrix* tangent) const {
  const double advance = settings_.theta * dt;
  const Points start = mesh_.points + displacement, acceleration = (velocity - start_velocity) / advance;
  VectorXd forces = VectorXd::Zero(unknowns());
  VectorXd holding = held_.size() > 0 ? held_ : VectorXd::Zero(unknowns());
  if (tension_held_.size() > 0) holding += tension_held_;
  if (tangent != nullptr) std::fill_n(tangent->valuePtr(), tangent->nonZeros(), 0.0);
  elements_->step_force({start, velocity, acceleration, settings_.theta, dt, settings_.conserve_energy},
                        {&*material_, settings_.viscosity, settings_.density}, forces, tangent);
  const Points middle = displacement + advance * velocity;
  for (const SurfaceSupport& support : supports_)
    support.add({middle, velocity, time + advance, advance, &acceleration}, holding, tangent);
  share_.complete(holding);
  forces -= holding;
  for (int unknown : clamped_) forces[unknown] = 0;
  if (tangent != nullptr) constrain(*tangent, clamped_, first_entry(share_, *tangent));
  return forces;
}

}  // namespace tether
