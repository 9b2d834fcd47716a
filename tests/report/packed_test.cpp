#include "report/packed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/base64.hpp"
#include "report/wall.hpp"

namespace tether {
namespace {

TEST(Packed, NumbersInQuanta) {
  const std::vector<std::int16_t> expected{2, -3, -32768, 0};
  const MatrixXd numbers = (MatrixXd(2, 2) << 0.2, std::nan(""), -0.26, 0.04).finished();
  EXPECT_EQ(packed16(numbers, 0.1), base64(expected.data(), 8)) << "column by column";
  EXPECT_THROW(packed16(MatrixXd::Constant(1, 1, 4000), 0.1), std::runtime_error);
  const std::vector<std::int32_t> whole{-1, 70000};
  EXPECT_EQ(packed32(whole), base64(whole.data(), 8));
}

/// One triangle of 30 by 40 mm that is off by 0.5 mm at one node, and not measured at another.
TEST(Packed, AWallInMillimetres) {
  Wall wall{{0, 1, 2}, {"spine"}, {0, 0, -1}, 10, {}};
  const Points places = (Points(3, 3) << 0, 3, 0, 0, 0, 4, 0, 0, 0).finished();
  const VectorXd distances = (VectorXd(3) << 0.05, -0.0125, std::nan("")).finished();
  wall.sources.push_back({"ct", false, {{0.25, true, {places}, {{places, distances}}}}});

  const auto json = nlohmann::json::parse(json_of(wall));
  EXPECT_EQ(json["nodes"], 3);
  const auto& moment = json["sources"][0]["moments"][0];
  EXPECT_EQ(moment["time"], 0.25);
  EXPECT_TRUE(moment["held_out"]);
  EXPECT_NEAR(json["distance_quantum"].get<double>(), 0.5 / 32000, 1e-12) << "[mm]";
  const std::vector<std::int16_t> expected{32000, -8000, -32768};
  EXPECT_EQ(moment["states"][0]["distances"], base64(expected.data(), 6));
  EXPECT_NEAR(json["place_quantum"].get<double>(), 20.0 / 32000, 1e-12) << "half of 40 mm";
  const std::vector<std::int16_t> corners{-24000, -32000, 0, 24000, -32000, 0, -24000, 32000, 0};
  EXPECT_EQ(moment["states"][0]["positions"], base64(corners.data(), 18)) << "from the middle";
  EXPECT_EQ(moment["lines"][0], moment["states"][0]["positions"]);
}

}  // namespace
}  // namespace tether
