/// The moving wall of a page is read from files that anybody may have made.
#include "report/wall.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/config/case_text.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace wall_test {

/// Two triangles of four nodes at one moment.
ComparedWall square() {
  Points positions(3, 4);
  positions << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  const MatrixXd distances = Eigen::RowVector4d(0.1, -0.1, std::nan(""), 0.2);
  ComparedWall wall;
  wall.units = "cgs";
  wall.triangles = {0, 1, 2, 0, 2, 3};
  wall.regions = {"front", "back"};
  wall.region = {0, 1, 1, -1};
  wall.sources = {{"ct", false, {{0.1, false, packed(positions), packed(distances), {packed(positions)}}}}};
  return wall;
}

class WallFile : public ::testing::Test {
 protected:
  Wall read(const ComparedWall& wall) const {
    write_record(folder / "wall.json", wall);
    return wall_of({folder.path()});
  }
  /// What is said of the square with something else in it.
  std::string said(const std::function<void(ComparedWall&)>& change) const {
    ComparedWall wall = square();
    change(wall);
    return input_error_of([&] { read(wall); });
  }
  TemporaryFolder folder;
};

TEST_F(WallFile, IsReadAsItWasWritten) {
  const Wall wall = read(square());
  ASSERT_EQ(wall.sources.size(), 1U);
  ASSERT_EQ(wall.sources[0].moments.size(), 1U);
  const WallMoment& moment = wall.sources[0].moments[0];
  ASSERT_EQ(moment.states.size(), 1U);
  EXPECT_EQ(moment.states[0].positions.col(2), Vec3(1, 1, 0));
  EXPECT_FLOAT_EQ(moment.states[0].distances[3], 0.2F);
  EXPECT_EQ(moment.data.size(), 1U);
}

TEST_F(WallFile, OfNumbersThatDoNotBelongTogetherIsRefused) {
  const auto moment = [](ComparedWall& wall) -> WallMomentTold& { return wall.sources[0].moments[0]; };
  EXPECT_EQ(said([&](ComparedWall& w) { moment(w).positions = packed(MatrixXd::Zero(2, 6)); }),
            "2 x 6 numbers are no points");
  EXPECT_EQ(said([&](ComparedWall& w) { moment(w).lines[0] = packed(MatrixXd::Zero(4, 3)); }),
            "4 x 3 numbers are no points");
  EXPECT_EQ(said([&](ComparedWall& w) {
              moment(w).positions = packed(MatrixXd::Constant(3, 4, std::numeric_limits<double>::infinity()));
            }),
            "3 x 4 numbers are no points");
  EXPECT_EQ(said([&](ComparedWall& w) { moment(w).distances = packed(MatrixXd::Zero(1, 5)); }),
            "positions and distances of 4 and 5 nodes, where the wall has 4");
  EXPECT_EQ(said([&](ComparedWall& w) {
              moment(w).positions.shape = {2'000'000'000, 2'000'000'000};
            }),
            "48 bytes are not 2000000000 x 2000000000 numbers");
  EXPECT_EQ(said([&](ComparedWall& w) { moment(w).positions.shape = {3}; }), "packed numbers have no rows and columns");
}

TEST_F(WallFile, OfNodesOrRegionsThatItDoesNotHaveIsRefused) {
  const std::string file = (folder / "wall.json").string();
  const std::vector<std::vector<int>> wrong{{0, 1, 4}, {0, 1, -1}, {0, 1}};
  for (const std::vector<int>& triangles : wrong)
    EXPECT_EQ(said([&](ComparedWall& w) { w.triangles = triangles; }),
              file + ": triangles of nodes that it does not have");
  for (const int region : {2, -2})
    EXPECT_EQ(said([&](ComparedWall& w) { w.region[0] = region; }), file + ": nodes in regions that it does not have");
}

}  // namespace wall_test
}  // namespace tether
