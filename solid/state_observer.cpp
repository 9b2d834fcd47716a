#include "solid/state_observer.hpp"

#include "common/base/error.hpp"
#include "common/base/mark.hpp"
#include "common/linalg/krylov.hpp"
#include "common/mesh/surface.hpp"
#include "solid/inflation_stiffness.hpp"
#include "solid/wall_share.hpp"

#include <algorithm>

namespace tether {
namespace {

constexpr double stiffer_than_the_wall = 100;  ///< what is left of a smooth distance is a hundredth
constexpr double least_weight = 0.1;           ///< of the mean, for a node to count as observed
constexpr double tolerance = 1e-3;  ///< of the extension: a rough one shakes the wall, and the coupling works longer
constexpr int most_iterations = 60, worth_a_factor = 12;
constexpr double largest_move = 0.25;  ///< of the local mesh size, in one step

/// Mean length of the interface's edges at each node.
VectorXd local_mesh_size(const WallMesh& mesh) {
  VectorXd sum = VectorXd::Zero(mesh.interface_nodes), count = sum;
  for (const Triangle& t : mesh.interface)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const double length = (mesh.points.col(a) - mesh.points.col(b)).norm();
      for (const int node : {a, b}) sum[node] += length, count[node] += 1;
    }
  return sum.cwiseQuotient(count);
}

}  // namespace

StateObserver::StateObserver(const WallModel& model, VectorXd gain)
    : share_(model.share()),
      interface_nodes_(model.mesh().interface_nodes),
      gain_(std::move(gain)),
      mesh_size_(local_mesh_size(model.mesh())),
      factor_(symmetric_solver(share_)) {
  TETHER_ASSERT(gain_.size() == interface_nodes_, "{} gains of {} nodes", gain_.size(), interface_nodes_);
  const WallMesh& mesh = model.mesh();
  const auto wall = make_wall_elements(mesh, mesh.points, share_);
  VectorXd none = VectorXd::Zero(model.unknowns());
  K_ = wall->zero_matrix();
  wall->static_force(mesh.points, model.material(), none, &K_);
  for (const SurfaceSupport& support : model.supports()) support.add_stiffness(K_);
  constrain(K_, model.clamped_unknowns(), first_entry(share_, K_));
  kappa_ = stiffer_than_the_wall * inflation_stiffness(mesh, *wall, model.material());
  normal_ = nodal_normals(mesh.points, mesh.interface).leftCols(interface_nodes_);
  area_ = nodal_areas(mesh.points, mesh.interface).head(interface_nodes_);
  for (int unknown : model.clamped_unknowns())
    if (unknown / 3 < interface_nodes_) area_[unknown / 3] = 0;
  area_ = (gain_.array() > 0).select(area_, 0);
}

Points StateObserver::correction(const NodalDistances& data, double dt) {
  return extend(data, limited(data, (1 - (-dt * gain_.array()).exp()) * data.distance.array()));
}

Points StateObserver::drift(const NodalDistances& data, double dt) {
  const VectorXd gain = gain_.cwiseMin(0.5 / dt);
  return extend(data, limited(data, dt * gain.cwiseProduct(data.distance))) / dt;
}

/// How far the lumen is to move in a step, at most a quarter of the local mesh size.
VectorXd StateObserver::limited(const NodalDistances& data, const VectorXd& target) {
  const VectorXd most = largest_move * mesh_size_, cut = target.cwiseMin(most).cwiseMax(-most);
  for (Eigen::Index a = 0; a < target.size(); ++a) limited_ += data.weight[a] > 0 && cut[a] != target[a] ? 1 : 0;
  return cut;
}

/// A of the nodes that the data stand for.
VectorXd StateObserver::observed_area(const NodalDistances& data) const {
  const double observed = static_cast<double>((data.weight.array() > 0).count());
  const double least = least_weight * data.weight.sum() / std::max(1.0, observed);
  return (data.weight.array() > least).select(area_, 0);
}

/// (K + kappa A) e
VectorXd StateObserver::times(const VectorXd& observed, const VectorXd& e) const {
  VectorXd result = K_ * e;
  share_.complete(result);
  for (Eigen::Index a = 0; a < interface_nodes_; ++a) {
    const Vec3 n = normal_.col(a);
    result.segment<3>(3 * a) += kappa_ * observed[a] * n.dot(e.segment<3>(3 * a)) * n;
  }
  return result;
}

void StateObserver::factor(const VectorXd& observed) {
  SparseMatrix A = K_;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a)
    if (observed[a] > 0 && share_.is_own(static_cast<int>(a)))
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          A.coeffRef(static_cast<int>(3 * a) + i, static_cast<int>(3 * a) + j) +=
              kappa_ * observed[a] * normal_(i, a) * normal_(j, a);
  if (!factor_->has_factor()) factor_->analyze(A, 3);
  factor_->factor(A);
  factored_ = observed;
}

Points StateObserver::extend(const NodalDistances& data, const VectorXd& target) {
  const VectorXd observed = observed_area(data);
  VectorXd rhs = VectorXd::Zero(K_.rows()), e = rhs;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a)
    rhs.segment<3>(3 * a) = kappa_ * observed[a] * target[a] * data.normal.col(a).dot(normal_.col(a)) * normal_.col(a);
  if (rhs.isZero(0)) return Points::Zero(3, rhs.size() / 3);
  if (factored_.size() == 0) factor(observed);
  if (factored_ == observed) return factor_->solve(rhs).reshaped(3, rhs.size() / 3);
  const auto solve = [&] {
    e.setZero();
    return conjugate_gradients([&](const VectorXd& v) { return times(observed, v); },
                               [&](const VectorXd& r) { return factor_->solve(r); }, rhs, e, tolerance,
                               most_iterations);
  };
  KrylovResult result = solve();
  if (!result.converged || result.iterations > worth_a_factor) {
    factor(observed);
    result = solve();
  }
  if (!result.converged) throw run_error("the observer's equations did not converge");
  return e.reshaped(3, rhs.size() / 3);
}

VectorXd StateObserver::state() const {
  VectorXd state = VectorXd::Zero(state_size());
  if (factored_.size() > 0) state << factored_, Mark().add(factored_).value();
  return state;
}

void StateObserver::set_state(const VectorXd& state) {
  TETHER_ASSERT(state.size() == state_size(), "{} of {} numbers", state.size(), state_size());
  const VectorXd observed = state.head(interface_nodes_);
  if (Mark().add(observed).value() != state[interface_nodes_]) return;
  if (factored_.size() == 0 || factored_ != observed) factor(observed);
}

}  // namespace tether
