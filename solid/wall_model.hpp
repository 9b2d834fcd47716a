#pragma once

#include <memory>
#include <vector>

#include "common/base/configured.hpp"
#include "common/base/parameter_table.hpp"
#include "solid/elements/wall_elements.hpp"
#include "solid/initial_stress.hpp"
#include "solid/local_effect.hpp"
#include "solid/surface_support.hpp"
#include "solid/wall_zones.hpp"

namespace tether {

/// What the wall is, apart from how it moves: geometry, material, surroundings.
struct WallSettings {
  std::string material;                  ///< a name of `materials()`
  std::vector<double> material_values;   ///< in its declaration's order
  double density = undefined;            ///< [density]
  double viscosity = 0.0;                ///< eta_s [pressure time]
  double theta = 0.5;                    ///< of the midpoint rule, 0.5 to 1
  bool conserve_energy = false;          ///< needs theta = 0.5
  bool support_on_current_area = false;  ///< areas at the start of each step, else those of the imaged wall
};

/// Wall with material and supports; all parameters settable by name. The processes of a team call the same functions
/// with the same arguments: forces are whole in each, of matrices it has the rows of its own nodes.
class WallModel {
 public:
  /// `stress_free`: positions without stress (the imaged ones, if there is no prestress). `clamped`: nodes that do not
  /// move.
  WallModel(WallMesh mesh, const WallSettings& settings, const Points& stress_free, std::vector<int> clamped_nodes,
            std::vector<SurfaceSupport> supports, std::vector<LocalEffect> effects = {}, Team& team = alone());
  WallModel(const WallModel&) = delete;  // the parameter table refers into this object
  WallModel& operator=(const WallModel&) = delete;

  /// Rings whose nodes may be among the clamped ones, and then move (S.23).
  void drive(std::vector<DrivenRing> rings);
  /// Those that move now: nothing has loosened them, and they or their tissue have a motion.
  const std::vector<DrivenRing>& driven() const { return driven_; }

  /// The imaged wall carries this stress, and the surroundings hold the rest.
  void set_initial_stress(const InitialStress& initial);

  const WallMesh& mesh() const { return mesh_; }
  /// Of the nodes, between the processes of the team.
  const Share& share() const { return share_; }
  const WallSettings& settings() const { return settings_; }
  const WallElements& elements() const { return *elements_; }
  const Material& material() const { return *material_; }
  /// Those of the clamped and driven nodes, and of rings whose clamp nothing replaces now: their velocity is given.
  const std::vector<int>& clamped_unknowns() const { return clamped_; }
  const std::vector<SurfaceSupport>& supports() const { return supports_; }
  const ParameterTable& parameters() const { return parameters_; }
  Eigen::Index unknowns() const { return mesh_.points.size(); }

  /// Areas and normals of the supports for a step that starts at displacement y (S.4).
  void place_supports(const Points& displacement);

  /// Left side of the step's equations (S.5): inertia, internal and support forces, less what the surroundings hold;
  /// tangent, if not null, is set to its derivative by V, clamped unknowns eliminated. Entries of clamped unknowns are
  /// zero.
  VectorXd step_forces(const Points& displacement, const Points& start_velocity, const Points& velocity, double time,
                       double dt, SparseMatrix* tangent) const;

 private:
  void declare_parameters();
  void declare_supports();
  std::string path_of(const SurfaceSupport& support) const;
  void orient_supports();
  void attach_present();
  void declare_tissue(MovingTissue& tissue);
  void update_clamps();
  void place_effects();
  void update_effects();

  WallMesh mesh_;
  Share share_;
  WallSettings settings_;
  Configured<Material> material_;
  std::unique_ptr<WallElements> elements_;
  std::vector<SurfaceSupport> supports_;
  std::vector<LocalEffect> effects_;
  std::vector<DrivenRing> rings_, driven_;
  std::vector<const MovingTissue*> tissues_;  ///< whose numbers are declared
  std::vector<WallZone> zones_;
  std::vector<std::vector<double>> mixtures_;  ///< of zones, of elements that several share: what each has
  VectorXd
      tension_held_;  ///< by the surroundings, so that tension along the vessel leaves the image at rest; empty if none
  VectorXd held_;     ///< force of the surroundings beside the supports, a dead load; empty if none
  std::vector<int> always_clamped_, clamped_;
  ParameterTable parameters_;
};

/// Unknowns 3 node + component of the nodes.
std::vector<int> unknowns_of(const std::vector<int>& nodes);

}  // namespace tether
