#include <cblas.h>
#include <cholmod.h>

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/process.hpp"
#include "common/linalg/blas_kernels.hpp"
#include "common/linalg/cholesky.hpp"
#include "common/linalg/supernodal.hpp"
#include "solid/wall_model.hpp"

/// What the largest kernels of a step do to memory and arithmetic, beside what one core of the machine can: for `run`.
///
///   kernels_benchmark AROUND ALONG LAYERS     a line each: name, seconds, operations (0: not counted), bytes
namespace tether {
namespace {

double least_seconds(const std::function<void()>& work) {
  double least = 1e300;
  for (int i = 0; i < 12; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

void print(const char* name, double seconds, double operations, double bytes) {
  std::printf("%s %.6g %.6g %.6g\n", name, seconds, operations, bytes);
}

/// a <- b + s c over arrays that no cache holds; a line is read before it is written.
void stream() {
  constexpr Eigen::Index n = 1 << 24;
  VectorXd a = VectorXd::Zero(n), b = VectorXd::Ones(n), c = VectorXd::Ones(n);
  const double seconds = least_seconds([&] { a.noalias() = b + 0.5 * c; });
  print("stream", seconds, 2.0 * n, 32.0 * n);
}

void dense() {
  constexpr int n = 1200;
  const MatrixXd a = MatrixXd::Random(n, n), b = MatrixXd::Random(n, n);
  MatrixXd c = MatrixXd::Zero(n, n);
  const double seconds = least_seconds([&] {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1, a.data(), n, b.data(), n, 0, c.data(), n);
  });
  print("dense", seconds, 2.0 * n * n * n, 32.0 * n * n);
}

/// Of configs/tube, but for its lumen and the names of its patches.
WallMesh tube(int around, int along, int layers) {
  WallMesh mesh;
  mesh.interface_nodes = around * (along + 1);
  mesh.points.resize(3, Eigen::Index{mesh.interface_nodes} * (layers + 1));
  for (int node = 0; node < mesh.points.cols(); ++node) {
    const int place = node % mesh.interface_nodes, layer = node / mesh.interface_nodes;
    const double angle = 2 * std::numbers::pi * (place % around) / around, radius = 2 + 0.2 * layer / layers;
    const int ring = place / around;
    mesh.points.col(node) << radius * std::cos(angle), radius * std::sin(angle), 10.0 * ring / along;
  }
  for (int ring = 0; ring < along; ++ring)
    for (int i = 0; i < around; ++i) {
      const int a = ring * around + i, b = ring * around + (i + 1) % around, c = a + around, d = b + around;
      mesh.interface.push_back({a, b, d});
      mesh.interface.push_back({a, d, c});
    }
  for (int layer = 0; layer < layers; ++layer)
    for (const Triangle& t : mesh.interface) {
      const int in = layer * mesh.interface_nodes, out = in + mesh.interface_nodes;
      mesh.prisms.push_back({t[0] + in, t[1] + in, t[2] + in, t[0] + out, t[1] + out, t[2] + out});
    }
  return mesh;
}

/// A wall at rest, held at its first ring, that moves a little.
struct Wall {
  Wall(const WallMesh& mesh, std::vector<int> held)
      : model(mesh,
              {.material = "neo_hookean",
               .material_values = {4e6, 0.45},
               .density = 1.2,
               .viscosity = 0,
               .conserve_energy = false,
               .support_on_current_area = true},
              mesh.points, std::move(held), {}),
        displacement(1e-3 * mesh.points),
        velocity(1e-2 * mesh.points),
        prisms(static_cast<double>(mesh.prisms.size())),
        tangent(model.elements().zero_matrix()) {}

  void evaluate(bool with_tangent) {
    model.step_forces(displacement, velocity, velocity, 0, 2e-3, with_tangent ? &tangent : nullptr);
  }

  WallModel model;
  Points displacement, velocity;
  double prisms;
  SparseMatrix tangent;
};

void elements(Wall& wall) {
  const double vectors = 8.0 * 4 * static_cast<double>(wall.displacement.size());
  wall.evaluate(true);
  print("forces", least_seconds([&] { wall.evaluate(false); }), 0, vectors);
  const double matrix = 16.0 * static_cast<double>(wall.tangent.nonZeros()), places = 4.0 * 18 * 18 * wall.prisms;
  print("tangent", least_seconds([&] { wall.evaluate(true); }), 0, vectors + matrix + places);
}

void wall_solve(const SparseMatrix& tangent) {
  Cholesky factor;
  factor.analyze(tangent, 3);
  if (!factor.factor_roughly(tangent, 1e-2)) return;
  VectorXd x = VectorXd::Ones(tangent.rows());
  const double bytes = 2e6 * factor.factor_megabytes();
  print("wall_solve", least_seconds([&] { factor.solve_in_place(x); }), bytes / 2, bytes);
}

/// (grad p, grad q) of tetrahedra, six a cube, in a box of a x a x b nodes, held at one of them.
SparseMatrix laplacian(int a, int b) {
  constexpr int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};  // through the cube
  const int stride[3] = {1, a, a * a};
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}};
  for (int k = 0; k + 1 < b; ++k)
    for (int j = 0; j + 1 < a; ++j)
      for (int i = 0; i + 1 < a; ++i)
        for (const auto& way : ways) {
          const int corner = i + a * (j + a * k),
                    nodes[4] = {corner, corner + stride[way[0]], corner + stride[way[0]] + stride[way[1]],
                                corner + stride[0] + stride[1] + stride[2]};
          for (const int p : nodes)
            for (const int q : nodes) entries.emplace_back(p, q, 0.0);
          for (int step = 0; step < 3; ++step)  // gradients are 1 along an edge of the way, and 0 along others
            for (const auto& [p, q, sign] : {std::tuple{0, 0, 1}, {1, 1, 1}, {0, 1, -1}, {1, 0, -1}})
              entries.emplace_back(nodes[step + p], nodes[step + q], sign / 6.0);
        }
  SparseMatrix matrix(a * a * b, a * a * b);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Written once and read once: the least that a factorisation can do.
void pressure_factor(const SparseMatrix& matrix) {
  Cholesky factor;
  factor.analyze(matrix);
  const double seconds = least_seconds([&] { factor.factor(matrix); });
  cholmod_common common{};
  prepare_cholmod(common);
  cholmod_sparse view = view_of(matrix);
  std::vector<int> order = order_by_nodes(matrix, 1, common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  cholmod_factor* symbolic = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common);
  print("pressure_factor", seconds, common.fl, 2e6 * factor.factor_megabytes());
  cholmod_free_factor(&symbolic, &common);
  cholmod_finish(&common);
  VectorXd x = VectorXd::Ones(matrix.rows());
  const double bytes = 2e6 * factor.factor_megabytes();
  print("pressure_solve", least_seconds([&] { factor.solve_in_place(x); }), bytes / 4, bytes);
}

int main_of(const std::vector<std::string>& words) {
  if (words.size() != 3) return 2;
  const int around = std::stoi(words[0]);
  std::vector<int> held(static_cast<std::size_t>(around));
  std::iota(held.begin(), held.end(), 0);
  const WallMesh mesh = tube(around, std::stoi(words[1]), std::stoi(words[2]));
  Wall wall(mesh, held);
  stream();
  dense();
  elements(wall);
  wall_solve(wall.tangent);
  pressure_factor(laplacian(around / 3 + 1, std::stoi(words[1])));
  return 0;
}

}  // namespace
}  // namespace tether

int main(int argc, char** argv) {
  tether::prepare_process();
  tether::prepare_blas();
  return tether::main_of({argv + 1, argv + argc});
}
