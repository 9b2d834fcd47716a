#pragma once

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "observation_manager/measurements/observations.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observation_manager/lumens.hpp"

/// Files of measurements as people have them, and a case that names them.
namespace tether::testing {
namespace load_test {

inline constexpr double pi = std::numbers::pi;

inline TriangleSurface vessel(double radius, double factor = 1) {
  return scaled(tube(16, 8, 4, [radius](double) { return radius; }), factor);
}

inline std::string ply(const TriangleSurface& surface) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "{}\n"
      "property list uchar int vertex_indices\nend_header\n",
      surface.points.cols(), surface.triangles.size());
  for (const auto& x : surface.points.colwise()) text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : surface.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

inline std::string vtp(const TriangleSurface& surface) {
  std::string points, cells, offsets;
  for (const auto& x : surface.points.colwise()) points += fmt::format("{} {} {} ", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : surface.triangles) {
    cells += fmt::format("{} {} {} ", a, b, c);
    offsets += fmt::format("{} ", 3 * (std::count(offsets.begin(), offsets.end(), ' ') + 1));
  }
  return fmt::format(
      "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\"><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{}</DataArray></Points><Polys>"
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{}</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">{}</DataArray></Polys></Piece></PolyData></VTKFile>\n",
      surface.points.cols(), surface.triangles.size(), points, cells, offsets);
}

/// A contour about the z axis at height z [mm], as rows of the table.
inline std::string circle_rows(const std::string& slice, int frame, double time, double radius, double z,
                               int points = 24) {
  std::string rows;
  for (int i = 0; i < points; ++i)
    rows += fmt::format("{},{},{},{:.6f},{:.6f},{}\n", slice, frame, time, radius * std::cos(2 * pi * i / points),
                        radius * std::sin(2 * pi * i / points), z);
  return rows;
}

/// The same farther along x [mm].
inline std::string moved_rows(const std::string& rows, double by) {
  std::istringstream lines(rows);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
    cells[3] = fmt::format("{}", std::stod(cells[3]) + by);
    all += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return all;
}

inline constexpr const char* heading = "slice,frame,time [ms],x [mm],y [mm],z [mm]\n";

class Load : public ::testing::Test {
 protected:
  /// The measurements of a case in cgs whose lumen is a tube of radius 1 cm, from 0 to 0.8 s.
  Observations load(const std::string& observations) {
    folder.file("case.yaml", "name: tube\nunits: cgs\ntime: {step: 1e-2, end: 0.8}\nobservations:\n" + observations);
    CaseFile file(folder / "case.yaml");
    ObservationsCase given;
    file.read("observations", given);
    file.finish();
    return load_observations(given, model, file);
  }
  std::string message(const std::string& observations) {
    std::string text = message_of([&] { load(observations); });
    const std::string path = folder.path().string() + "/";
    for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
    return text;
  }
  double first_distance(const Observations& data, double time) {
    return data.observe(model.points, time).at(40).distance;
  }

  TemporaryFolder folder;
  LumenSurface model = lumen(vessel(1));
};

}  // namespace load_test
}  // namespace tether::testing
