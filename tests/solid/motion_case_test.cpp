// The motion of a ring in a case file: what its tables may hold, and what is said of wrong ones.
#include <gtest/gtest.h>

#include "solid/case.hpp"
#include "tests/config/case_text.hpp"
#include "tests/solid/tube.hpp"

namespace tether {
namespace motion_case_test {

PreparedWall wall_moved_by(const std::string& motion) {
  const auto path = write_file("case.yaml", valid_head +
                                                "solid:\n"
                                                "  density: 1.1\n"
                                                "  material: {type: neo_hookean, young: 4e6, poisson: 0.45}\n"
                                                "  rings: {inlet_ring: {type: driven, motion: " +
                                                motion + "}}\n");
  CaseFile file(path);
  SolidCase solid;
  file.read("solid", solid);
  file.finish();
  return prepare_wall(solid, circular_tube(2, 2, 0.2, 8, 3).wall, file);
}

Vec3 moved(const PreparedWall& wall, const Vec3& x, double time) {
  return wall.model->driven().at(0).anchor.at(time).at(x);
}

TEST(MotionOfARing, FromPointsInMillimetresAndPhases) {
  write_file("ring.csv",
             "phase,point,x,y,z\n0,a,10,0,0\n0,b,0,10,0\n0,c,-10,0,0\n"
             "0.5,b,0,10,5\n0.5,a,10,0,5\n0.5,c,-10,0,5\n");
  const PreparedWall wall =
      wall_moved_by("{file: ring.csv, table: points, clock: phase, time: phase, unit: mm, period: 0.8}");
  EXPECT_LT((moved(wall, Vec3(2, 0, 0), 0.4) - Vec3(0, 0, 0.5)).norm(), 1e-14)
      << "the order of the points does not count";
  EXPECT_LT((moved(wall, Vec3(2, 0, 0), 0.8 + 0.2) - Vec3(0, 0, 0.25)).norm(), 1e-14);
  ASSERT_FALSE(wall.notices.empty());
  EXPECT_NE(wall.notices[0].find("ring inlet_ring: moves as ring.csv says, its centre by 5 mm at most"),
            std::string::npos)
      << wall.notices[0];
}

TEST(MotionOfARing, FromPosesInDegreesAboutTheRingsCentre) {
  write_file("ring.csv", "time,x,y,z,turn_x [deg],turn_y [deg],turn_z [deg]\n0,7,7,7,0,0,0\n1,7,7,9,0,0,90\n");
  const PreparedWall wall =
      wall_moved_by("{file: ring.csv, table: poses, placement: {x_axis: [0, 1, 0], y_axis: [-1, 0, 0]}}");
  const Vec3 outermost(2, 0, 0);  // the inlet's ring is about the origin
  EXPECT_LT((moved(wall, outermost, 1) - Vec3(-2, 2, 2)).norm(), 1e-12);
  const PreparedWall straight = wall_moved_by("{file: ring.csv, table: poses, follow: centre}");
  EXPECT_LT((moved(straight, outermost, 1) - Vec3(0, 0, 2)).norm(), 1e-14);
}

TEST(MotionOfARing, TheWallsRingIsAmongWhatDoesNotAnswerForces) {
  write_file("ring.csv", "time,x,y,z\n0,0,0,0\n1,0,0,1\n");
  const PreparedWall wall = wall_moved_by("{file: ring.csv}");
  EXPECT_EQ(3 * wall.model->driven().at(0).nodes.size() * 2, wall.model->clamped_unknowns().size()) << "both rings";
}

TEST(MotionOfARing, MistakesAreNamed) {
  const auto error = [](const std::string& table, const std::string& fields) {
    write_file("ring.csv", table);
    return input_error_of([&] { wall_moved_by("{file: ring.csv" + fields + "}"); });
  };
  const auto says = [&](const std::string& table, const std::string& fields, const std::string& part) {
    const std::string said = error(table, fields);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  const std::string rows = "time,x,y,z\n0,0,0,0\n1,0,0,1\n", points = "time,point,x,y,z\n";
  says(rows, ", harmonics: 2", "needs 'period'");
  says(rows, ", clock: phase", "needs 'period'");
  says(rows, ", period: 0.8, harmonics: 2", "5 different phases");
  says(rows, ", time: when", "when");
  says("time [ms],x,y,z\n0,0,0,0\n1,0,0,1\n", ", clock: phase, period: 0.8",
       "ring.csv:2: time is in ms, but with clock: phase times are parts of the period: must have no unit");
  says("time,x [mm],y,z\n0,0,0,0\n1,0,0,1\n", ", unit: cm",
       "ring.csv:2: column 'x': is in mm by its heading, in cm by the case: must be the same, or stated once");
  says("time,x,y,z\n0,0,0,0\n0,0,0,1\n", "", "ring.csv:3: the time 0 does not come after 0");
  says("time,x,y,z\n1,0,0,0\n0,0,0,1\n", "", "ring.csv:3");
  says("time,x,y,z\n0,0,0,0\n1,0,nan,1\n", "", "ring.csv:3");
  says(points + "0,a,0,0,0\n0,b,1,0,0\n", ", table: points", "a pose needs three");
  says(points + "0,a,0,0,0\n0,b,1,0,0\n0,c,2,0,0\n", ", table: points", "on a line");
  says(points + "0,a,0,0,0\n0,b,1,0,0\n0,c,0,1,0\n1,a,0,0,0\n1,b,1,0,0\n", ", table: points",
       "2 points at this time, 3");
  says(points + "0,a,0,0,0\n0,b,1,0,0\n0,c,0,1,0\n1,a,0,0,0\n1,b,1,0,0\n1,d,1,0,0\n", ", table: points",
       "ring.csv:7: the point d is not there at the first time");
  says(points + "0,a,0,0,0\n0,b,1,0,0\n0,a,0,1,0\n", ", table: points", "ring.csv:4: the point a is there twice");
  says("time,x,y,z,turn_x,turn_y,turn_z\n0,0,0,0,0,0,0\n1,0,0,0,0,0,3\n", ", table: poses", "turns by 172 degrees");
  says("time,x,y,z,turn_x [m],turn_y,turn_z\n0,0,0,0,0,0,0\n", ", table: poses", "in rad or deg");
  says(rows, ", unit: s", "ring.csv:2: column 'x'");
  says(rows, ", placement: {x_axis: [1, 0, 0], y_axis: [1, 0, 0]}", "right angle");
  says(rows, ", placement: {x_axis: [0, 0, 0], y_axis: [1, 0, 0]}", "x_axis: must not be zero");
  says(rows, ", table: poses", "turn_x");
  EXPECT_NE(input_error_of([] { wall_moved_by("{table: points}"); }).find("file"), std::string::npos);
}

}  // namespace motion_case_test
}  // namespace tether
