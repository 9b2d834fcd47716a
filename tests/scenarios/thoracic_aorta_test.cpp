/// configs/thoracic_aorta: the commands of its README, from a surface to the first steps of a beat.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/io/lumen_motion.hpp"
#include "solid/motion_case.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "vessel/mesh_file.hpp"

namespace tether {
namespace thoracic_aorta_test {

namespace fs = std::filesystem;

const std::string configs = TETHER_SOURCE "/configs/thoracic_aorta/", data = TETHER_SOURCE "/data/";

/// A file of the config, at another size and with what it builds on in this test's folder.
fs::path own(const std::string& name, Edits edits) {
  if (name != "outlets.yaml") edits.emplace_back("../../", TETHER_SOURCE "/");
  return case_variant(configs + name, test_folder() / fs::path(name).stem(), edits);
}

void make(const std::string& verb, const fs::path& file, const fs::path& output) {
  const ChildEnd end = capture({{TETHER_PROGRAM, verb, file.string(), "--output", output.string()}, {}});
  ASSERT_EQ(end.exit_code, exit_done) << end.errors << end.output;
}

/// Nodes of the lumen's inlet face that lie on the wall, as imaged.
Points inlet_rim(const Points& lumen) {
  const MeshFile faces = read_mesh_file(test_folder() / "model/model/lumen_faces.vtu");
  const auto& labels = faces.triangle_labels.at("ModelFaceID");
  std::vector<Vec3> rim;
  for (std::size_t t = 0; t < labels.size(); ++t) {
    if (labels[t] != 1) continue;
    for (const int node : faces.triangles[t])
      if ((lumen.colwise() - faces.points.col(node)).colwise().norm().minCoeff() < 1e-9)
        rim.push_back(faces.points.col(node));
  }
  Points result(3, static_cast<Eigen::Index>(rim.size()));
  for (std::size_t i = 0; i < rim.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = rim[i];
  return result;
}

/// The motion that beat.yaml asks for, and the centre about which the placed ring turns: that of the wall's end face.
RigidMotion motion_of_the_case() {
  MotionCase given;
  given.file = data + "heart_motion_patient1/ring_points.csv";
  given.table = "points", given.clock = given.time = "phase", given.unit = "mm";
  given.x = "x_mm", given.y = "y_mm", given.z = "z_mm";
  given.period = 0.8955, given.harmonics = 3;
  given.placement = {{0.8616, 0.4140, -0.2937}, {-0.2574, 0.8551, 0.4501}};
  const MeshFile faces = read_mesh_file(test_folder() / "model/model/wall_faces.vtu");
  const auto& labels = faces.triangle_labels.at("ModelFaceID");
  const std::int64_t last_region = 7;  // the interface is 0, six regions follow, then the rings
  Patch ring;
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (labels[t] == last_region) ring.triangles.push_back(faces.triangles[t]);
  return given.load(UnitSystem::cgs(), ring, faces.points);
}

TEST(ThoracicAorta, ComesFromItsSurfaceAndIsPulledByTheHeart) {
  make("build-model", own("study.yaml", {}), test_folder() / "model");
  make("fit-outlets",
       own("outlets.yaml", {{"../../out/thoracic_aorta/model", (test_folder() / "model/model").string()}}),
       test_folder() / "fitted");
  make("simulate",
       own("beat.yaml",
           {{"../../out/thoracic_aorta_outlets", (test_folder() / "fitted").string()}, {"end: 0.8955", "end: 0.02"}}),
       test_folder() / "run");

  const CsvTable series(test_folder() / "run/timeseries.csv", TableOf::tether);
  ASSERT_EQ(series.rows(), 10U);
  for (const double error : series.numbers("fluid.mass_balance_error")) EXPECT_LT(std::abs(error), 1e-9) << "cm3/s";
  for (const double jacobian : series.numbers("fluid.smallest_jacobian")) EXPECT_GT(jacobian, 0.9);
  const std::map<std::string, double> shares{
      {"brachiocephalic", 0.15}, {"left_carotid", 0.05}, {"left_subclavian", 0.10}, {"descending", 0.70}};
  const auto first_flow = [&](const std::string& outlet) {
    return series.numbers("fluid." + outlet + ".flow").front();
  };
  double outflow = 0;
  for (const auto& [outlet, share] : shares) outflow += first_flow(outlet);
  for (const auto& [outlet, share] : shares)
    EXPECT_NEAR(first_flow(outlet) / outflow, share, 0.1) << outlet << ": as asked of a beat's mean";
  const double start = series.numbers("fluid.ascending.pressure").front() / 1333.22;
  EXPECT_NEAR(start, 0, 5) << "mmHg above the image: the outlets begin in their beat";

  const LumenMotion lumen(test_folder() / "run/lumen.motion");
  const Points rim = inlet_rim(lumen.imaged());
  ASSERT_GT(rim.cols(), 20);
  const RigidMotion motion = motion_of_the_case();
  const double time = lumen.times().back();
  const Points now = lumen.at(time);
  double worst = 0, way = 0;
  for (const auto& x : rim.colwise()) {
    Eigen::Index node = 0;
    (lumen.imaged().colwise() - x).colwise().norm().minCoeff(&node);
    worst = std::max(worst, (now.col(node) - x - motion(time).at(x)).norm());
    way = std::max(way, (now.col(node) - x).norm());
  }
  EXPECT_GT(way, 0.02) << "cm";
  EXPECT_LT(worst, 1e-6 * way) << "single precision of lumen.motion";
}

}  // namespace thoracic_aorta_test
}  // namespace tether
