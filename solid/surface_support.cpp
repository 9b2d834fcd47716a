#include "solid/surface_support.hpp"

#include <Eigen/Geometry>

namespace tether {
namespace {

/// The quadrature points are the midpoints of the edges (degree 2): edge e joins corners e and e + 1.
constexpr int corner(int edge, int end) {
  return (edge + end) % 3;
}

}  // namespace

SurfaceSupport::SurfaceSupport(Patch patch, Configured<Support> support, TissueMotion motion)
    : patch_(std::move(patch)), support_(std::move(support)), motion_(std::move(motion)) {}

void SurfaceSupport::attach(const SparseMatrix& pattern) {
  scatter_ = ScatterMap(pattern, 3, std::span<const Triangle>(patch_.triangles));
}

void SurfaceSupport::place(const Points& x) {
  faces_.clear();
  for (const Triangle& t : patch_.triangles) {
    const Vec3 twice = (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
    faces_.push_back({twice.norm() / 2, twice.normalized()});
  }
}

SupportTraction SurfaceSupport::at(const SupportStep& step, std::size_t triangle, int edge) const {
  const Triangle& t = patch_.triangles[triangle];
  const int a = t[static_cast<std::size_t>(corner(edge, 0))], b = t[static_cast<std::size_t>(corner(edge, 1))];
  SupportPoint point{(step.displacement.col(a) + step.displacement.col(b)) / 2,
                     (step.velocity.col(a) + step.velocity.col(b)) / 2, faces_[triangle].normal};
  if (motion_) point.displacement -= motion_(step.time);
  return support_->at(point);
}

void SurfaceSupport::add(const SupportStep& step, VectorXd& force, SparseMatrix* tangent) const {
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k) {
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> block = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
    const double weight = faces_[k].area / 3;
    for (int edge = 0; edge < 3; ++edge) {
      const SupportTraction response = at(step, k, edge);
      const Mat3 by_velocity = step.advance * response.stiffness + response.damping;
      for (int m = 0; m < 2; ++m) {
        const int a = corner(edge, m);
        force.segment<3>(3 * patch_.triangles[k][static_cast<std::size_t>(a)]) += weight / 2 * response.traction;
        for (int n = 0; n < 2; ++n) block.block<3, 3>(3 * a, 3 * corner(edge, n)) += weight / 4 * by_velocity;
      }
    }
    if (tangent != nullptr) scatter_.add(*tangent, k, block.data());
  }
}

void SurfaceSupport::add_stiffness(SparseMatrix& K) const {
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k) {
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> block = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
    for (int edge = 0; edge < 3; ++edge) {
      const Mat3 stiffness = support_->at({Vec3::Zero(), Vec3::Zero(), faces_[k].normal}).stiffness;
      for (int m = 0; m < 2; ++m)
        for (int n = 0; n < 2; ++n)
          block.block<3, 3>(3 * corner(edge, m), 3 * corner(edge, n)) += faces_[k].area / 12 * stiffness;
    }
    scatter_.add(K, k, block.data());
  }
}

Vec3 SurfaceSupport::resultant(const SupportStep& step) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k)
    for (int edge = 0; edge < 3; ++edge) sum += faces_[k].area / 3 * at(step, k, edge).traction;
  return sum;
}

}  // namespace tether
