#include <cstdio>
#include <ctime>

#include "tests/solid/tube_errors.hpp"

/// How the wall's elements lock, and what they cost: tubes in plane strain against Lame and Michell. Radius 2, wall
/// 0.2 if not stated. Errors in percent of the exact displacement, negative: too stiff.
namespace tether {
namespace {

constexpr std::array poisson_ratios{0.3, 0.45, 0.499};

void print_head(const char* what) {
  std::printf("\n| %-42s | inflation 0.3 |  0.45 | 0.499 | ovalisation 0.3 |  0.45 | 0.499 |\n", what);
  std::printf("|---|---|---|---|---|---|---|\n");
}

void print_row(const std::string& what, const TubeMesh& tube, const WallMesh& wall) {
  std::array<TubeErrors, 3> errors;
  for (std::size_t i = 0; i < 3; ++i) errors[i] = tube_errors(tube, wall, poisson_ratios[i]);
  std::printf("| %-42s |", what.c_str());
  for (const TubeErrors& e : errors) std::printf(" %.2f |", 100 * e.inflation);
  for (const TubeErrors& e : errors) std::printf(" %.2f |", 100 * e.ovalisation);
  std::printf("\n");
}

/// Nodes moved along the surface by up to that part of their distance, the same in all layers; the ends stay plane.
WallMesh with_moved_nodes(WallMesh wall, const TubeMesh& tube, double part) {
  Random random(3);
  const double spacing = 2 * std::numbers::pi / tube.around, end = wall.points.row(2).maxCoeff();
  for (int node = 0; node < wall.interface_nodes; ++node) {
    const double turn = part * spacing * random(), shift = part * spacing * tube.radius * random();
    for (Eigen::Index at = node; at < wall.points.cols(); at += wall.interface_nodes) {
      auto x = wall.points.col(at);
      x.head<2>() = Eigen::Rotation2D(turn) * Eigen::Vector2d(x.head<2>());
      if (x[2] > 1e-9 * end && x[2] < (1 - 1e-9) * end) x[2] += shift;
    }
  }
  return wall;
}

void elements() {
  print_head("element, nodes around, 2 layers");
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron})
    for (const int around : {24, 48, 96}) {
      const TubeMesh tube{around, 2, kind};
      print_row(std::string(name_of(kind)) + " " + std::to_string(around), tube, tube_slice(tube));
    }
}

void refinement() {
  print_head("element, nodes around x layers");
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron})
    for (const int around : {24, 48, 96}) {
      const TubeMesh tube{around, around / 12, kind};
      print_row(name_of(kind) + (" " + std::to_string(around)) + " x " + std::to_string(tube.layers), tube,
                tube_slice(tube));
    }
}

void layers() {
  print_head("prism, 24 around, layers");
  for (const int count : {1, 2, 4, 8}) print_row(std::to_string(count), {24, count}, tube_slice({24, count}));
}

void diagonals() {
  print_head("prism, all diagonals one way, around x layers");
  for (const TubeMesh& tube : {TubeMesh{24, 1}, {24, 2}, {48, 1}, {48, 2}})
    print_row(std::to_string(tube.around) + " x " + std::to_string(tube.layers), tube,
              with_one_way_diagonals(tube_slice(tube)));
}

void distortion() {
  print_head("prism, 24 around, nodes moved by, layers");
  for (const int count : {1, 2})
    for (const double part : {0.1, 0.2, 0.3})
      print_row(std::to_string(part).substr(0, 3) + ", " + std::to_string(count), {24, count},
                with_moved_nodes(tube_slice({24, count}), {24, count}, part));
}

void thickness() {
  print_head("prism, wall over radius, around x layers");
  for (const auto& [ratio, count] : {std::pair{0.01, 1}, {0.05, 1}, {0.1, 1}, {0.2, 1}, {0.2, 2}, {0.5, 1}, {0.5, 3}})
    for (const int around : {24, 48}) {
      const TubeMesh tube{around, count, ElementKind::prism, 1.0, ratio};
      const std::string mesh = std::to_string(around) + " x " + std::to_string(count);
      print_row(std::to_string(ratio).substr(0, 4) + ", " + mesh, tube, tube_slice(tube));
    }
}

/// Processor time, the least of some repetitions: other programs on the machine count little.
double milliseconds(const std::function<void()>& work) {
  double least = 1e300;
  for (int i = 0; i < 20; ++i) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

void cost() {
  std::printf(
      "\n| tube of length 10, 48 x 40 x 2  | elements | unknowns | forces | and tangent | factor | solve [ms] |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  const auto material = neo_hookean.make(std::array{4e6, 0.45});
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron}) {
    const WallMesh wall = with_elements(circular_tube(2, 10, 0.2, 48, 40, 2).wall, kind);
    const auto elements = make_wall_elements(wall, wall.points);
    const Points x = 1.05 * wall.points;
    VectorXd force = VectorXd::Zero(wall.points.size());
    SparseMatrix tangent = elements->zero_matrix();
    const double forces = milliseconds([&] { elements->static_force(x, *material, force, nullptr); });
    const double both = milliseconds([&] { elements->static_force(x, *material, force, &tangent); });
    tangent = elements->zero_matrix();
    elements->static_force(wall.points, *material, force, &tangent);
    constrain(tangent, plane_strain_supports(wall), tangent.coeff(0, 0));
    Cholesky cholesky;
    cholesky.analyze(tangent, 3);
    const double factor = milliseconds([&] { cholesky.factor(tangent); });
    const double solve = milliseconds([&] { force = cholesky.solve(force); });
    std::printf("| %s | %zu | %ld | %.1f | %.1f | %.0f | %.1f |\n", name_of(kind),
                std::max(wall.prisms.size(), wall.tetrahedra.size()), static_cast<long>(force.size()), forces, both,
                factor, solve);
  }
}

}  // namespace
}  // namespace tether

int main() {
  tether::elements();
  tether::refinement();
  tether::layers();
  tether::diagonals();
  tether::distortion();
  tether::thickness();
  tether::cost();
}
