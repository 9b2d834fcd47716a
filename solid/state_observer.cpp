#include "solid/state_observer.hpp"

#include "common/base/error.hpp"
#include "common/base/mark.hpp"
#include "common/linalg/krylov.hpp"
#include "common/mesh/surface.hpp"
#include "solid/inflation_stiffness.hpp"

#include <algorithm>

namespace tether {
namespace {

constexpr double stiffer_than_the_wall = 100;  ///< what is left of a smooth distance is a hundredth
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
    : interface_nodes_(model.mesh().interface_nodes),
      gain_(std::move(gain)),
      mesh_size_(local_mesh_size(model.mesh())),
      nodal_area_(total_area(model.mesh().points, model.mesh().interface) / static_cast<double>(interface_nodes_)),
      clamped_(model.clamped_unknowns()) {
  TETHER_ASSERT(gain_.size() == interface_nodes_, "{} gains of {} nodes", gain_.size(), interface_nodes_);
  const auto wall = make_wall_elements(model.mesh(), model.mesh().points);
  VectorXd none = VectorXd::Zero(model.unknowns());
  K_ = wall->zero_matrix();
  wall->static_force(model.mesh().points, model.material(), none, &K_);
  for (const SurfaceSupport& support : model.supports()) support.add_stiffness(K_);
  constrain(K_, clamped_, K_.coeff(0, 0));
  kappa_ = stiffer_than_the_wall * inflation_stiffness(model.mesh(), *wall, model.material());
}

Points StateObserver::correction(const NodalDistances& data, double dt) {
  VectorXd target = (1 - (-dt * gain_.array()).exp()) * data.distance.array();
  const VectorXd most = largest_move * mesh_size_, cut = target.cwiseMin(most).cwiseMax(-most);
  for (Eigen::Index a = 0; a < target.size(); ++a) limited_ += data.weight[a] > 0 && cut[a] != target[a] ? 1 : 0;
  return extend(data, cut);
}

Points StateObserver::drift(const NodalDistances& data) {
  return extend(data, gain_.cwiseProduct(data.distance));
}

/// Weights to the scale of areas, whatever they stand for; nodes without gain are not observed.
StateObserver::Pattern StateObserver::pattern_of(const NodalDistances& data) const {
  Pattern pattern{data.weight, data.normal};
  double sum = 0, count = 0;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a) {
    if (gain_[a] == 0) pattern.weight[a] = 0;
    for (int i = 0; i < 3; ++i)
      if (std::binary_search(clamped_.begin(), clamped_.end(), 3 * static_cast<int>(a) + i)) pattern.weight[a] = 0;
    sum += pattern.weight[a];
    count += pattern.weight[a] > 0 ? 1 : 0;
  }
  if (sum > 0) pattern.weight *= nodal_area_ * count / sum;
  return pattern;
}

/// (K + kappa W) e
VectorXd StateObserver::times(const Pattern& pattern, const VectorXd& e) const {
  VectorXd result = K_ * e;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a) {
    const Vec3 n = pattern.normal.col(a);
    result.segment<3>(3 * a) += kappa_ * pattern.weight[a] * n.dot(e.segment<3>(3 * a)) * n;
  }
  return result;
}

void StateObserver::factor(const Pattern& pattern) {
  SparseMatrix A = K_;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a)
    if (pattern.weight[a] > 0)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          A.coeffRef(static_cast<int>(3 * a) + i, static_cast<int>(3 * a) + j) +=
              kappa_ * pattern.weight[a] * pattern.normal(i, a) * pattern.normal(j, a);
  if (!factor_.has_factor()) factor_.analyze(A, 3);
  factor_.factor(A);
  factored_ = pattern;
}

Points StateObserver::extend(const NodalDistances& data, const VectorXd& target) {
  const Pattern pattern = pattern_of(data);
  VectorXd rhs = VectorXd::Zero(K_.rows()), e = rhs;
  for (Eigen::Index a = 0; a < interface_nodes_; ++a) {
    if (pattern.weight[a] == 0) continue;
    rhs.segment<3>(3 * a) = kappa_ * pattern.weight[a] * target[a] * pattern.normal.col(a);
  }
  if (rhs.isZero(0)) return Points::Zero(3, rhs.size() / 3);
  if (factored_.empty()) factor(pattern);
  const auto solve = [&] {
    e.setZero();
    return conjugate_gradients([&](const VectorXd& v) { return times(pattern, v); },
                               [&](const VectorXd& r) { return factor_.solve(r); }, rhs, e, tolerance, most_iterations);
  };
  KrylovResult result = solve();
  if (!result.converged || result.iterations > worth_a_factor) {
    factor(pattern);
    result = solve();
  }
  if (!result.converged) throw run_error("the observer's equations did not converge");
  return e.reshaped(3, rhs.size() / 3);
}

VectorXd StateObserver::state() const {
  VectorXd state = VectorXd::Zero(state_size());
  if (!factored_.empty())
    state << factored_.weight, factored_.normal.reshaped(),
        Mark().add(factored_.weight).add(factored_.normal.reshaped()).value();
  return state;
}

void StateObserver::set_state(const VectorXd& state) {
  TETHER_ASSERT(state.size() == state_size(), "{} of {} numbers", state.size(), state_size());
  const Pattern pattern{state.head(interface_nodes_),
                        state.segment(interface_nodes_, 3 * interface_nodes_).reshaped(3, interface_nodes_)};
  if (Mark().add(pattern.weight).add(pattern.normal.reshaped()).value() != state[state.size() - 1]) return;
  const bool is_at_hand =
      !factored_.empty() && pattern.weight == factored_.weight && pattern.normal == factored_.normal;
  if (pattern.weight.maxCoeff() > 0 && !is_at_hand) factor(pattern);
}

}  // namespace tether
