#include "solid/surface_support.hpp"

#include <Eigen/Geometry>

#include "solid/vessel_direction.hpp"

namespace tether {
namespace {

/// The quadrature points are the midpoints of the edges (degree 2): edge e joins corners e and e + 1.
constexpr int corner(int edge, int end) {
  return (edge + end) % 3;
}

}  // namespace

SurfaceSupport::SurfaceSupport(Patch patch, Configured<Support> support, TissueMotion motion, std::string path)
    : patch_(std::move(patch)), support_(std::move(support)), motion_(std::move(motion)), path_(std::move(path)) {}

void SurfaceSupport::attach(const SparseMatrix& pattern) {
  scatter_ = ScatterMap(pattern, 3, std::span<const Triangle>(patch_.triangles));
}

void SurfaceSupport::place(const Points& x) {
  const bool first = faces_.empty();
  faces_.resize(patch_.triangles.size());
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Triangle& t = patch_.triangles[k];
    Mat3 corners;
    corners << x.col(t[0]), x.col(t[1]), x.col(t[2]);
    const Vec3 twice = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    Face& face = faces_[k];
    face.area = twice.norm() / 2;
    face.normal = twice.normalized();
    if (first) face.corners = corners;
    face.axial.setZero();
    if (along_) face.axial = direction_on(corners, {(*along_)[t[0]], (*along_)[t[1]], (*along_)[t[2]]});
  }
}

/// y_b: where the tissue's springs are at rest.
Vec3 SurfaceSupport::rest_at(double time) const {
  Vec3 rest = motion_ ? motion_(time) : Vec3::Zero();
  for (const auto& tissue : tissues_)
    if (!tissue->motion.is_absent()) rest += tissue->motion->at(time, tissue->measured);
  return rest;
}

SupportTraction SurfaceSupport::at(const SupportStep& step, const Vec3& rest, std::size_t triangle, int edge) const {
  const Triangle& t = patch_.triangles[triangle];
  const Face& face = faces_[triangle];
  const int p = corner(edge, 0), q = corner(edge, 1);
  const int a = t[static_cast<std::size_t>(p)], b = t[static_cast<std::size_t>(q)];
  SupportPoint point{(step.displacement.col(a) + step.displacement.col(b)) / 2 - rest,
                     (step.velocity.col(a) + step.velocity.col(b)) / 2, face.normal};
  if (step.acceleration != nullptr) point.acceleration = (step.acceleration->col(a) + step.acceleration->col(b)) / 2;
  point.axial = face.axial;
  point.position = (face.corners.col(p) + face.corners.col(q)) / 2;
  point.time = step.time;
  return support_->at(point);
}

void SurfaceSupport::add(const SupportStep& step, VectorXd& force, SparseMatrix* tangent) const {
  if (support_.is_absent()) return;
  const Vec3 rest = rest_at(step.time);
  const double acceleration_by_velocity = step.acceleration != nullptr ? 1 / step.advance : 0;
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k) {
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> block = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
    const double weight = faces_[k].area / 3;
    for (int edge = 0; edge < 3; ++edge) {
      const SupportTraction response = at(step, rest, k, edge);
      const Mat3 by_velocity =
          step.advance * response.stiffness + response.damping + acceleration_by_velocity * response.inertia;
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
  if (support_.is_absent()) return;
  const Points still = Points::Zero(3, 1 + nodes_of(patch_.triangles).back());
  const SupportStep at_rest{still, still, 0, 0};
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k) {
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> block = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
    for (int edge = 0; edge < 3; ++edge) {
      const Mat3 stiffness = at(at_rest, Vec3::Zero(), k, edge).stiffness;
      for (int m = 0; m < 2; ++m)
        for (int n = 0; n < 2; ++n)
          block.block<3, 3>(3 * corner(edge, m), 3 * corner(edge, n)) += faces_[k].area / 12 * stiffness;
    }
    scatter_.add(K, k, block.data());
  }
}

Vec3 SurfaceSupport::resultant(const SupportStep& step) const {
  Vec3 sum = Vec3::Zero();
  if (support_.is_absent()) return sum;
  const Vec3 rest = rest_at(step.time);
  for (std::size_t k = 0; k < patch_.triangles.size(); ++k)
    for (int edge = 0; edge < 3; ++edge) sum += faces_[k].area / 3 * at(step, rest, k, edge).traction;
  return sum;
}

}  // namespace tether
