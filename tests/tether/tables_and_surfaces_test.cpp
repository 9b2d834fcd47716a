// Verbs that work on surfaces and tables: what they tell and write, and into which folders they do not.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/results/noise.hpp"
#include "tests/scenarios/surface_file.hpp"
#include "tests/tether/front_end.hpp"
#include "twin/noise.hpp"

namespace tether {
namespace front_end_test {

/// A tube of radius 10 and length 60 with errors of the deviation 0.3, alike over 5, a fifth of the variance nowhere.
void write_tube(const fs::path& path, std::uint64_t seed, double scale = 1) {
  constexpr int around = 20, along = 21;
  Points x(3, around * along), out(3, around * along);
  for (int i = 0; i < x.cols(); ++i) {
    const int ring = i / around;
    const double angle = 2 * std::numbers::pi * (i % around) / around;
    out.col(i) = Vec3(std::cos(angle), std::sin(angle), 0);
    x.col(i) = 10 * out.col(i) + Vec3(0, 0, 60.0 / 20 * ring);
  }
  const VectorXd error = 0.3 * (std::sqrt(0.8) * RandomField(5, Random(seed, 0), CorrelationShape::gaussian)(x) +
                                std::sqrt(0.2) * RandomField(0, Random(seed, 1))(x));
  x += out * error.asDiagonal();
  std::vector<Triangle> triangles;
  for (int i = 0; i < around * (along - 1); ++i) {
    const int side = i / around * around + (i + 1) % around;
    triangles.push_back({i, side, side + around}), triangles.push_back({i, side + around, i + around});
  }
  write_stl(path, scale * x, triangles);
}

TEST_F(FrontEnd, WritesAndTellsTheNoiseOfTwoSurfaces) {
  write_tube(folder_ / "one.stl", 1), write_tube(folder_ / "two.stl", 2);
  const ChildEnd end = tether("measure-noise one.stl two.stl --output noise");
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const auto noise = read_record<NoiseMeasurements>(folder_ / "noise/noise.json");
  ASSERT_EQ(noise.measurements.size(), 1u);
  const MeasuredNoise& one = noise.measurements.front();
  EXPECT_EQ(one.from, NoiseOrigin::repeated);
  EXPECT_GT(one.points, 380);
  EXPECT_EQ(one.fits.front().shape, CorrelationShape::gaussian);
  EXPECT_NEAR(one.fits.front().deviation.value, 0.3, 0.06);
  EXPECT_NEAR(one.fits.front().correlation_length.value, 5, 1.5);
  EXPECT_NE(end.output.find(one.line), std::string::npos) << end.output;
  EXPECT_EQ(one.line.rfind("noise: {deviation: ", 0), 0u) << one.line;
  EXPECT_TRUE(fs::exists(folder_ / "noise/plots/noise_repeated_one_stl_and_two_stl.png"));
  EXPECT_EQ(tether("measure-noise one.stl none.stl").exit_code, 2);
}

TEST_F(FrontEnd, TellsNoNoiseOfSurfacesThatAreNoTwoOfOneMoment) {
  write_tube(folder_ / "one.stl", 1), write_tube(folder_ / "large.stl", 2, 10), write_tube(folder_ / "two.stl", 2);
  fs::copy_file(folder_ / "one.stl", folder_ / "same.stl");
  const auto refusal = [&](const std::string& files) {
    const ChildEnd end = tether("measure-noise " + files);
    EXPECT_EQ(end.exit_code, 2) << end.output;
    return end.errors;
  };
  EXPECT_EQ(refusal("one.stl same.stl"),
            "one.stl and same.stl: are the same surface: must be two segmentations, which differ by their noise\n");
  for (const auto& [files, named] :
       {std::pair{"one.stl large.stl", "one.stl and large.stl: "}, {"large.stl one.stl", "large.stl and one.stl: "}}) {
    const std::string said = refusal(files);
    EXPECT_EQ(said.rfind(named, 0), 0u) << said;
    EXPECT_NE(said.find("unit"), std::string::npos) << said;
  }
}

TEST_F(FrontEnd, MeasuresNoiseIntoNoFolderOfOtherFiles) {
  write_tube(folder_ / "one.stl", 1), write_tube(folder_ / "two.stl", 2), write_tube(folder_ / "three.stl", 3);
  EXPECT_EQ(tether("measure-noise one.stl none.stl --output noise").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "noise")) << "of a refused call";
  for (int again = 0; again < 2; ++again)
    EXPECT_EQ(tether("measure-noise one.stl two.stl --output noise").exit_code, 0);
  const std::string of_two = content("noise/noise.json");
  const ChildEnd other = tether("measure-noise one.stl three.stl --output noise");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.errors.find("two.stl; choose another folder with --output, or give --overwrite\n"), std::string::npos)
      << other.errors;
  EXPECT_EQ(content("noise/noise.json"), of_two);
  EXPECT_EQ(tether("measure-noise one.stl three.stl --overwrite --output noise").exit_code, 0);
  EXPECT_NE(content("noise/noise.json"), of_two);
  EXPECT_FALSE(fs::exists(folder_ / "noise/plots/noise_repeated_one_stl_and_two_stl.png"));
  fs::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "mine/noise.json") << "precious";
  EXPECT_EQ(tether("measure-noise one.stl two.stl --output mine").exit_code, 2);
  EXPECT_EQ(content("mine/noise.json"), "precious");
  EXPECT_FALSE(fs::exists(folder_ / "mine/.lock"));
  EXPECT_EQ(tether("measure-noise one.stl two.stl --output . --overwrite").exit_code, 2) << "they would be replaced";
}

TEST_F(FrontEnd, MakesNoFolderOfATableThatIsRefused) {
  std::ofstream(folder_ / "cases.csv") << "name, time.end [s]\n../mine, 0.2\n";
  const ChildEnd job = tether("submit simulate case.yaml --table cases.csv --output job --time 20 --memory 1G");
  EXPECT_EQ(job.exit_code, 2) << job.output;
  EXPECT_NE(job.errors.find("cases.csv"), std::string::npos) << job.errors;
  EXPECT_FALSE(fs::exists(folder_ / "job"));
  write_tube(folder_ / "one.stl", 1);
  std::ofstream(folder_ / "frames.csv") << "file, time\none.stl, 0\n";
  std::ofstream(folder_ / "ring.yaml") << "name: root\nframes: {file: frames.csv, unit: mm}\n";
  const ChildEnd ring = tether("track-ring ring.yaml --output ring");
  EXPECT_EQ(ring.exit_code, 2) << ring.output;
  EXPECT_NE(ring.errors.find("frames.csv"), std::string::npos) << ring.errors;
  EXPECT_FALSE(fs::exists(folder_ / "ring"));
}

/// A closed stream's number would be that of the next file, into which what is told would go.
TEST_F(FrontEnd, TellsNothingIntoAFileWhereItsOutputIsClosed) {
  write_tube(folder_ / "one.stl", 1), write_tube(folder_ / "two.stl", 2);
  const ChildEnd end = tether("measure-noise one.stl two.stl --output noise >&-");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  const std::string holder = content("noise/.lock");
  EXPECT_EQ(std::count(holder.begin(), holder.end(), '\n'), 1) << holder;
  EXPECT_LT(holder.size(), 300U);
}

}  // namespace front_end_test
}  // namespace tether
