// What a person sees: the picture program under a display of its own, its PNG read back.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "common/base/child_process.hpp"
#include "common/io/vtu_writer.hpp"
#include "common/mesh/sweep.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

struct Colour {
  double red, green, blue;
};

class Picture : public testing::Test {
 protected:
  void SetUp() override {
    const WallMesh wall = circular_tube(1, 4, 0.2, 16, 8).wall;
    Points x = wall.points;
    write_vtu(folder_ / "wall.vtu", wall.points, cells_of(wall),
              {Field::scalars("height", wall.points.row(2).transpose()), Field::vectors("displacement", x)}, {});
  }
  ChildEnd draw(const std::string& options) {
    return capture(
        {{"/bin/sh", "-c",
          "xvfb-run -a " TETHER_PICTURE " " + (folder_ / "wall.vtu").string() + " " + png_.string() + " " + options},
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

TEST_F(Picture, NamesAFieldThatIsNotThere) {
  const ChildEnd end = draw("--field stress");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("wall.vtu: has no field 'stress'"), std::string::npos) << end.errors;
}

}  // namespace
}  // namespace tether
