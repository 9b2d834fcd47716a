#include "solid/state_observer.hpp"

#include <gtest/gtest.h>

#include "common/mesh/surface.hpp"
#include "solid/materials/registry.hpp"
#include "solid/supports/registry.hpp"
#include "tests/solid/tube.hpp"

// The static extension of measured distances into the wall. Units: cm, g, s.
namespace tether {
namespace {

constexpr double gain = 15, dt = 2e-3;

/// A tube of radius 1 and length 4, held softly all round, its ends clamped.
std::unique_ptr<WallModel> tube(int around = 24) {
  WallMesh wall = circular_tube(1, 4, 0.15, around, around).wall;
  std::vector<int> clamped;
  for (const Patch& ring : wall.rings)
    for (int node : nodes_of(ring.triangles)) clamped.push_back(node);
  std::sort(clamped.begin(), clamped.end());
  std::vector<SurfaceSupport> supports;
  for (const Patch& region : wall.outside)
    supports.emplace_back(region, Configured<Support>(tether::supports(), "visco_elastic", {1e4, 0}));
  const WallSettings settings{.material = "neo_hookean", .material_values = {4e6, 0.45}, .density = 1.2};
  return std::make_unique<WallModel>(wall, settings, wall.points, clamped, std::move(supports));
}

StateObserver observer_of(const WallModel& model) {
  return {model, VectorXd::Constant(model.mesh().interface_nodes, gain)};
}

/// d = f(x) along the lumen's normals, everywhere.
NodalDistances distances(const WallModel& model, const std::function<double(const Vec3&)>& f) {
  const WallMesh& mesh = model.mesh();
  NodalDistances data{VectorXd::Ones(mesh.interface_nodes), VectorXd(mesh.interface_nodes),
                      nodal_normals(mesh.points, mesh.interface).leftCols(mesh.interface_nodes)};
  for (Eigen::Index a = 0; a < mesh.interface_nodes; ++a) data.distance[a] = f(mesh.points.col(a));
  return data;
}

/// A bulge that vanishes at the clamped ends and is larger on one side.
double bulge(const Vec3& x) {
  return 0.02 * std::sin(std::numbers::pi * x[2] / 4) * (1 + 0.5 * x[0]);
}

VectorXd normal_part(const Points& e, const NodalDistances& data) {
  return e.leftCols(data.weight.size()).cwiseProduct(data.normal).colwise().sum();
}

TEST(StateObserver, MovesTheObservedLumenByItsShareOfTheDistance) {
  const auto model = tube();
  const NodalDistances data = distances(*model, bulge);
  const Points e = observer_of(*model).correction(data, dt);
  const VectorXd wanted = (1 - std::exp(-gain * dt)) * data.distance;
  EXPECT_LT((normal_part(e, data) - wanted).norm(), 0.01 * wanted.norm());
  for (int unknown : model->clamped_unknowns()) EXPECT_EQ(e.reshaped()[unknown], 0);
  const Points rate = observer_of(*model).drift(data, dt);
  EXPECT_LT((normal_part(rate, data) - gain * data.distance).norm(), 0.01 * gain * data.distance.norm());
}

TEST(StateObserver, DriftsNoFasterThanAStepCanFollow) {
  const auto model = tube();
  const NodalDistances near = distances(*model, bulge);
  const double most = 0.5 / dt;
  const Points rate = StateObserver(*model, VectorXd::Constant(near.weight.size(), 100 * most)).drift(near, dt);
  EXPECT_LT((normal_part(rate, near) - most * near.distance).norm(), 0.01 * most * near.distance.norm());
  const NodalDistances far = distances(*model, [](const Vec3& x) { return 1e3 * bulge(x); });
  StateObserver observer(*model, VectorXd::Constant(far.weight.size(), 100 * most));
  EXPECT_LT(dt * normal_part(observer.drift(far, dt), far).cwiseAbs().maxCoeff(), 0.5) << "of the radius";
  EXPECT_GT(observer.limited(), 0);
}

TEST(StateObserver, CarriesTheWallsThicknessAlong) {
  const auto model = tube();
  const Points e = observer_of(*model).correction(distances(*model, bulge), dt);
  const Eigen::Index n = model->mesh().interface_nodes;
  const double inside = e.leftCols(n).norm(), outside = e.rightCols(n).norm();
  EXPECT_NEAR(outside / inside, 1, 0.15);
}

TEST(StateObserver, LeavesAWallThatAgreesAlone) {
  const auto model = tube();
  EXPECT_EQ(observer_of(*model).correction(distances(*model, [](const Vec3&) { return 0; }), dt).norm(), 0);
}

TEST(StateObserver, FillsASmallGapOfTheData) {
  const auto model = tube();
  NodalDistances data = distances(*model, bulge);
  const Points everywhere = observer_of(*model).correction(data, dt);
  for (Eigen::Index a = 0; a < data.weight.size(); ++a)
    if (std::abs(model->mesh().points(2, a) - 2) < 0.2) data.weight[a] = 0;
  const Points with_gap = observer_of(*model).correction(data, dt);
  EXPECT_LT((with_gap - everywhere).norm(), 0.2 * everywhere.norm());  // 0.67 wide; sqrt(R h) = 0.39
}

TEST(StateObserver, WithoutGainARegionIsNotObserved) {
  const auto model = tube();
  VectorXd gains = VectorXd::Constant(model->mesh().interface_nodes, gain);
  for (Eigen::Index a = 0; a < gains.size(); ++a)
    if (model->mesh().points(2, a) > 2) gains[a] = 0;
  StateObserver half(*model, gains);
  const NodalDistances data = distances(*model, bulge);
  const VectorXd moved = normal_part(half.correction(data, dt), data);
  int observed = 0, not_observed = 0;
  for (Eigen::Index a = 0; a < gains.size(); ++a) {
    const double z = model->mesh().points(2, a), wanted = z < 2 ? (1 - std::exp(-gain * dt)) * data.distance[a] : 0;
    if (z > 1.9 && z < 3) continue;  // a shell overshoots beside an edge
    EXPECT_NEAR(moved[a], wanted, 0.2 * moved.maxCoeff()) << z;
    ++(z < 2 ? observed : not_observed);
  }
  EXPECT_GT(observed, 0);
  EXPECT_GT(not_observed, 0);
}

/// A distance far beyond the mesh's size would fold it.
TEST(StateObserver, LimitsTheMoveOfAStep) {
  const auto model = tube();
  StateObserver observer = observer_of(*model);
  const Points e = observer.correction(distances(*model, [](const Vec3& x) { return 1e3 * bulge(x); }), dt);
  EXPECT_GT(observer.limited(), 0);
  EXPECT_LT(e.colwise().norm().maxCoeff(), 0.5 * 2 * std::numbers::pi / 24);
}

/// A lumen that is cut obliquely moves by d m.N along its normal when its trace moves by d along m in the slice.
TEST(StateObserver, TakesObliqueDistancesForWhatTheyAre) {
  const auto model = tube();
  NodalDistances data = distances(*model, bulge);
  const Points straight = observer_of(*model).correction(data, dt);
  for (Eigen::Index a = 0; a < data.weight.size(); ++a) {
    data.normal.col(a) = (data.normal.col(a) + Vec3(0, 0, 0.5)).normalized();
    data.distance[a] *= std::sqrt(1.25);
  }
  EXPECT_LT((observer_of(*model).correction(data, dt) - straight).norm(), 0.01 * straight.norm());
}

TEST(StateObserver, TheKeptFactorServesWhenSomeNodesAreNotObserved) {
  const auto model = tube();
  NodalDistances data = distances(*model, bulge);
  StateObserver kept = observer_of(*model);
  kept.correction(data, dt);
  for (Eigen::Index a = 0; a < data.weight.size(); a += 25) data.weight[a] = 0;
  const Points with_kept = kept.correction(data, dt), with_new = observer_of(*model).correction(data, dt);
  EXPECT_LT((with_kept - with_new).norm(), 5e-3 * with_new.norm());
}

TEST(StateObserver, ContinuesBitForBitFromItsState) {
  const auto model = tube(12);
  NodalDistances data = distances(*model, bulge);
  StateObserver first = observer_of(*model);
  first.correction(data, dt);
  StateObserver second = observer_of(*model);
  second.set_state(first.state());
  data.weight[30] = data.weight[31] = 0;
  EXPECT_EQ(first.correction(data, dt), second.correction(data, dt));
  StateObserver mixed = observer_of(*model);
  mixed.set_state(0.5 * (first.state() + second.state()) + VectorXd::Ones(first.state_size()));
  EXPECT_GT(mixed.correction(data, dt).norm(), 0) << "a mixture is no state, and no obstacle";
}

}  // namespace
}  // namespace tether
