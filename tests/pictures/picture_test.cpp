// What a person sees: the picture program under a display of its own, its PNG read back.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "common/base/child_process.hpp"
#include "common/io/vtp_writer.hpp"
#include "common/io/vtu_writer.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace {

struct Colour {
  double red, green, blue;
};

class Picture : public ::testing::Test {
 protected:
  void SetUp() override {
    const WallMesh wall = circular_tube(1, 4, 0.2, 16, 8).wall;
    Points x = wall.points;
    VectorXd above = wall.points.row(2).transpose();
    for (double& z : above) z = z < 1.9 ? std::nan("") : z;
    write_vtu(folder_ / "wall.vtu", wall.points, cells_of(wall),
              {Field::scalars("height", wall.points.row(2).transpose()), Field::vectors("displacement", x),
               Field::scalars("above", above)},
              {});
  }
  ChildEnd draw(const std::string& options) {
    return capture(
        {{"/bin/sh", "-c", TETHER_PICTURE " " + (folder_ / "wall.vtu").string() + " " + png_.string() + " " + options},
         {}});
  }
  Colour pixel(double across, double up) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(png_.c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    const int i = static_cast<int>(across * image->GetDimensions()[0]),
              j = static_cast<int>(up * image->GetDimensions()[1]);
    const auto c = [&](int k) { return image->GetScalarComponentAsDouble(i, j, 0, k); };
    return {c(0), c(1), c(2)};
  }

  TemporaryFolder folder_;
  std::filesystem::path png_ = folder_ / "picture.png";
};

/// The long axis is upright; dark violet where the field is small, yellow where it is large, white beside the vessel.
TEST_F(Picture, ShowsTheFieldInColoursFromTwoSides) {
  const ChildEnd end = draw("--field height --title 'height [cm]'");
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  for (const double view : {0.21, 0.63}) {
    const Colour low = pixel(view, 0.1), high = pixel(view, 0.9), beside = pixel(view - 0.2, 0.5);
    EXPECT_GT(low.blue, 1.3 * low.green);
    EXPECT_GT(high.green, 2 * high.blue);
    EXPECT_EQ(beside.red + beside.green + beside.blue, 3 * 255);
  }
}

/// Grey where the field says nothing, and a black line just within the wall.
TEST_F(Picture, ShowsWhatIsNotKnownAndLines) {
  Points circle(3, 91);
  for (int i = 0; i <= 90; ++i) circle.col(i) << 1.15 * std::cos(0.0698132 * i), 1.15 * std::sin(0.0698132 * i), 3;
  write_vtp(folder_ / "lines.vtp", {circle});
  const ChildEnd end = draw("--field above --diverging --range -4 4 --lines " + (folder_ / "lines.vtp").string());
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const Colour unknown = pixel(0.21, 0.2), known = pixel(0.21, 0.85);
  EXPECT_NEAR(unknown.red, unknown.blue, 3);
  EXPECT_LT(unknown.red, 240);
  EXPECT_GT(known.red, 1.5 * known.blue);
  double darkest = 255;
  for (double up = 0.65; up < 0.8; up += 0.002) darkest = std::min(darkest, pixel(0.21, up).red);
  EXPECT_LT(darkest, 60);
}

TEST_F(Picture, SaysThatItCannotBeWritten) {
  png_ = folder_ / "gone/picture.png";
  const ChildEnd end = draw("--field height");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("gone/picture.png: cannot be written: its folder is gone"), std::string::npos)
      << end.errors;
}

/// The X server that it starts goes with it.
TEST_F(Picture, LeavesNoServerWhenItIsKilled) {
  const ChildEnd end =
      capture({{"/bin/sh", "-c",
                TETHER_PICTURE " \"$0\" \"$1\" --field height & picture=$!; "
                               "until server=$(pgrep -P $picture -x Xvfb); do kill -0 $picture || exit 3; done; "
                               "kill -KILL $picture; "
                               "for i in $(seq 100); do kill -0 $server 2>/dev/null || exit 0; sleep 0.1; done; exit 4",
                (folder_ / "wall.vtu").string(), png_.string()},
               {}});
  EXPECT_EQ(end.exit_code, 0) << "3: no server was seen; 4: it lives on. " << end.errors;
}

TEST_F(Picture, NamesAFieldThatIsNotThere) {
  const ChildEnd end = draw("--field stress");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("wall.vtu: has no field 'stress'"), std::string::npos) << end.errors;
}

}  // namespace
}  // namespace tether
