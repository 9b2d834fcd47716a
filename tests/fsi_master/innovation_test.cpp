/// What the samples of measurements say to the interface's nodes (O.5).
#include <gtest/gtest.h>

#include "fsi_master/message_partners.hpp"
#include "observation_manager/measurements/surface_series.hpp"
#include "observation_manager/server.hpp"
#include "tests/observation_manager/lumens.hpp"

namespace tether {
namespace innovation_test {

/// Two samples by hand: on a triangle's nodes 0, 1, 2 along x, and at node 0 along y. Node 3 has none.
TEST(Innovation, WeighsDistancesAndNormalsByShares) {
  protocol::Discrepancy samples;
  samples.distances = {0.2, 0.1};
  samples.normals = {1, 0, 0, 0, 1, 0};
  samples.weights = {2, 1};
  samples.nodes = {0, 1, 2, 0, 0, 0};
  samples.shares = {0.5, 0.3, 0.2, 1, 0, 0};
  const Innovation nodal = at_nodes(samples, 4);
  EXPECT_LT((nodal.weights - Eigen::Vector4d(2, 0.6, 0.4, 0)).norm(), 1e-15);
  const double both = (0.2 + 0.1) / std::sqrt(2.0) / 2;  // (w d n along the mean normal) / w
  EXPECT_LT((nodal.distances - Eigen::Vector4d(both, 0.2, 0.2, 0)).norm(), 1e-15);
  const auto normals = nodal.normals.reshaped(3, 4);
  EXPECT_LT((normals.col(0) - Vec3(1, 1, 0).normalized()).norm(), 1e-15);
  EXPECT_LT((normals.col(1) - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(normals.col(3).norm(), 0);
}

TEST(Innovation, WithoutWeightSaysNothing) {
  protocol::Discrepancy samples;
  samples.distances = {0.2};
  samples.normals = {1, 0, 0};
  samples.weights = {0};
  samples.nodes = {1, 1, 1};
  samples.shares = {1, 0, 0};
  const Innovation nodal = at_nodes(samples, 2);
  EXPECT_EQ(nodal.weights.sum(), 0);
  EXPECT_EQ(nodal.distances.norm(), 0);
  EXPECT_TRUE(nodal.normals.allFinite());
}

/// As the observation manager sends them, of a tube that is wider by a tenth.
TEST(Innovation, OfAnInflatedTubeIsItsInflation) {
  const auto round = [](double radius) { return testing::tube(64, 20, 4, [radius](double) { return radius; }); };
  const LumenSurface model = testing::lumen(round(1));
  const SurfaceSeries series(testing::settings_for(model), {{std::nan(""), round(1.1), {}}}, {}, model);
  const std::vector<Sample> samples = series.observe(model.points, 0);
  const Innovation nodal = at_nodes(as_message(samples), model.points.cols());
  double sum = 0;
  for (const Sample& s : samples) sum += s.weight;
  EXPECT_NEAR(nodal.weights.sum(), sum, 1e-12 * sum);
  int observed = 0;
  for (Eigen::Index node = 0; node < nodal.weights.size(); ++node) {
    if (nodal.weights[node] == 0) continue;
    ++observed;
    EXPECT_NEAR(nodal.distances[node], 0.1, 2e-3);
    EXPECT_GT(nodal.normals.segment<3>(3 * node).dot(Vec3(model.points(0, node), model.points(1, node), 0)), 0.99);
  }
  EXPECT_GT(observed, 64 * 10);
}

}  // namespace innovation_test
}  // namespace tether
