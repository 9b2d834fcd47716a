#include "observation_manager/measurements/plane_cut.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <map>

#include "common/base/error.hpp"

namespace tether {
namespace {

using EdgeKey = std::array<int, 2>;

/// The part of the cut in one triangle, from the edge where it comes in to the edge where it leaves.
struct Segment {
  EdgeKey in, out;
};

EdgeKey key(int a, int b) {
  return a < b ? EdgeKey{a, b} : EdgeKey{b, a};
}

/// Walked around with the triangle, the edge that passes from before the plane to behind it is where the cut comes in.
std::map<EdgeKey, EdgeKey> segments(const std::vector<Triangle>& triangles, const VectorXd& height) {
  std::map<EdgeKey, EdgeKey> next;
  const auto before = [&](int node) { return height[node] >= 0; };
  for (const Triangle& t : triangles) {
    Segment segment{};
    bool crossed = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      if (before(a) == before(b)) continue;
      crossed = true;
      (before(a) ? segment.in : segment.out) = key(a, b);
    }
    if (crossed) next.emplace(segment.in, segment.out);
  }
  return next;
}

SurfacePlace crossing(const EdgeKey& edge, const VectorXd& height) {
  const double share = height[edge[0]] / (height[edge[0]] - height[edge[1]]);
  return {{edge[0], edge[1], edge[1]}, {1 - share, share, 0}};
}

CutPiece piece_through(const std::vector<EdgeKey>& edges, bool closed, const Points& x, const VectorXd& height) {
  CutPiece piece;
  piece.closed = closed;
  piece.points.resize(3, static_cast<Eigen::Index>(edges.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const SurfacePlace place = crossing(edges[i], height);
    piece.points.col(static_cast<Eigen::Index>(i)) =
        place.shares[0] * x.col(place.nodes[0]) + place.shares[1] * x.col(place.nodes[1]);
    piece.places.push_back(place);
  }
  return piece;
}

/// The edges from `first` on, taken out of `next`.
std::vector<EdgeKey> walk(std::map<EdgeKey, EdgeKey>& next, EdgeKey first) {
  std::vector<EdgeKey> edges{first};
  for (auto found = next.find(first); found != next.end(); found = next.find(edges.back())) {
    edges.push_back(found->second);
    next.erase(found);
  }
  return edges;
}

}  // namespace

std::vector<CutPiece> cut_by_plane(const Points& x, const std::vector<Triangle>& triangles, const SlicePlane& plane) {
  const VectorXd height = plane.normal.transpose() * (x.colwise() - plane.origin);
  std::map<EdgeKey, EdgeKey> next = segments(triangles, height);
  std::map<EdgeKey, int> arrivals;
  for (const auto& [in, out] : next) ++arrivals[out];
  std::vector<EdgeKey> beginnings;
  for (const auto& [in, out] : next)
    if (!arrivals.contains(in)) beginnings.push_back(in);
  std::vector<CutPiece> pieces;
  for (const EdgeKey& beginning : beginnings) pieces.push_back(piece_through(walk(next, beginning), false, x, height));
  while (!next.empty()) {
    std::vector<EdgeKey> edges = walk(next, next.begin()->first);
    edges.pop_back();  // the first again
    pieces.push_back(piece_through(edges, true, x, height));
  }
  return pieces;
}

FittedPlane fitted_plane(const std::string& name, const Points& points) {
  const Vec3 origin = points.rowwise().mean();
  const Points arms = points.colwise() - origin;
  const Eigen::SelfAdjointEigenSolver<Mat3> spread(arms * arms.transpose());
  if (!(spread.eigenvalues()[1] > 1e-12 * spread.eigenvalues()[2]))
    throw input_error("{}: its points lie on a line: they define no plane", name);
  const Vec3 e1 = spread.eigenvectors().col(2), e2 = spread.eigenvectors().col(1), normal = e1.cross(e2);
  return {{origin, e1, e2, normal}, (normal.transpose() * arms).cwiseAbs().maxCoeff()};
}

}  // namespace tether
