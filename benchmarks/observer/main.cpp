// Twin data from a finished run, and how far another run is from it.
//   observer_twin surfaces CASE RUN FOLDER FRAMES DEVIATION LENGTH SEED   STL surfaces of the run's lumen over its last
//   beat,
//       with normal errors of that deviation, correlated over that length [case's units]
//   observer_twin distance CASE RUN TRUTH                                 rms distance of a run's lumen to a run's,
//   over time
//   observer_twin roughness CASE DEVIATION LENGTH SAMPLES                 mean distance of the imaged lumen's nodes to
//   it with such errors, less the errors' mean
#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <random>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {
namespace {

LumenSurface lumen_of_case(const std::filesystem::path& path) {
  CaseFile file(path);
  MeshCase mesh;
  file.read("mesh", mesh);
  return lumen_of(load_mesh(mesh, file, WallElement::prism));
}

/// White noise at the nodes, averaged with exp(-r^2/(2 (l/2)^2)): its correlation is exp(-r^2/l^2).
VectorXd correlated_noise(const Points& x, double deviation, double length, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const VectorXd white = VectorXd::NullaryExpr(x.cols(), [&] { return normal(random); });
  VectorXd noise(x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    const VectorXd shares = (-2 / (length * length) * (x.colwise() - x.col(a)).colwise().squaredNorm().array()).exp();
    noise[a] = deviation * shares.dot(white) / shares.norm();
  }
  return noise;
}

void write_stl(const std::filesystem::path& path, const Points& x, const std::vector<Triangle>& triangles) {
  std::ofstream file(path);
  file << "solid lumen\n";
  for (const Triangle& t : triangles) {
    const Vec3 n = area_vector(x, t).normalized();
    file << fmt::format("facet normal {} {} {}\nouter loop\n", n[0], n[1], n[2]);
    for (int node : t) file << fmt::format("vertex {} {} {}\n", x(0, node), x(1, node), x(2, node));
    file << "endloop\nendfacet\n";
  }
  file << "endsolid lumen\n";
  if (!file) throw run_error("{} cannot be written", path.string());
}

void write_surfaces(const std::vector<std::string>& words) {
  const LumenSurface lumen = lumen_of_case(words.at(2));
  const LumenMotion motion(std::filesystem::path(words.at(3)) / "lumen.motion");
  const std::filesystem::path folder = words.at(4);
  const int frames = std::stoi(words.at(5));
  const double deviation = std::stod(words.at(6)), length = std::stod(words.at(7));
  std::mt19937 random(static_cast<unsigned>(std::stoul(words.at(8))));
  std::filesystem::create_directories(folder);
  std::ofstream list(folder / "frames.csv");
  list << "file, time [s]\n";
  for (int k = 0; k < frames; ++k) {
    const double time = motion.times().front() + (motion.times().back() - motion.times().front()) * k / (frames - 1);
    Points x = motion.at(time);
    x += nodal_normals(x, lumen.triangles) * correlated_noise(x, deviation, length, random).asDiagonal();
    write_stl(folder / fmt::format("lumen_{}.stl", k), x, lumen.triangles);
    list << fmt::format("lumen_{}.stl, {}\n", k, time);
  }
}

/// Along the normals of the true lumen, over its area.
void print_distance(const std::vector<std::string>& words) {
  const LumenSurface lumen = lumen_of_case(words.at(2));
  const LumenMotion run(std::filesystem::path(words.at(3)) / "lumen.motion"),
      truth(std::filesystem::path(words.at(4)) / "lumen.motion");
  for (const double time : run.times()) {
    const Points x = truth.at(time), n = nodal_normals(x, lumen.triangles);
    const VectorXd area = nodal_areas(x, lumen.triangles), d = n.cwiseProduct(run.at(time) - x).colwise().sum();
    std::cout << fmt::format("{} {}\n", time, std::sqrt(area.dot(d.cwiseAbs2()) / area.sum()));
  }
}

/// What errors of a surface do to the distance of the imaged lumen's nodes from it: their mean along the normal, over
/// area, is taken off, so that 0 is expected of a distance that measures along the normal. Of nodes beside no rim.
void print_roughness(const std::vector<std::string>& words) {
  const LumenSurface lumen = lumen_of_case(words.at(2));
  const double deviation = std::stod(words.at(3)), length = std::stod(words.at(4));
  const Points n = nodal_normals(lumen.points, lumen.triangles);
  const VectorXd area = nodal_areas(lumen.points, lumen.triangles);
  std::mt19937 random(1);
  VectorXd excess(std::stoi(words.at(5)));
  for (double& mean : excess) {
    const VectorXd noise = correlated_noise(lumen.points, deviation, length, random);
    const SignedSurface rough({lumen.points + n * noise.asDiagonal(), lumen.triangles});
    const std::vector<Closest> found = rough.closest(lumen.points);
    double sum = 0, seen = 0;
    for (Eigen::Index a = 0; a < noise.size(); ++a) {
      const Closest& c = found[static_cast<std::size_t>(a)];
      if (c.on_rim) continue;
      sum += area[a] * (c.distance - noise[a]);
      seen += area[a];
    }
    mean = sum / seen;
  }
  const auto count = static_cast<double>(excess.size());
  const double error = std::sqrt((excess.array() - excess.mean()).square().sum() / (count - 1) / count);
  std::cout << fmt::format("mean distance less mean error: {:.5f} +- {:.5f}\n", excess.mean(), error);
}

}  // namespace
}  // namespace tether

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  try {
    if (words.size() == 9 && words[1] == "surfaces")
      tether::write_surfaces(words);
    else if (words.size() == 5 && words[1] == "distance")
      tether::print_distance(words);
    else if (words.size() == 6 && words[1] == "roughness")
      tether::print_roughness(words);
    else
      throw tether::InputError(
          "observer_twin surfaces CASE RUN FOLDER FRAMES DEVIATION LENGTH SEED | distance CASE RUN TRUTH | "
          "roughness CASE DEVIATION LENGTH SAMPLES");
  } catch (const std::exception& error) {
    std::cerr << "observer_twin: " << error.what() << "\n";
    return 1;
  }
}
