#include "solid/surface_support.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "solid/vessel_direction.hpp"

namespace tether {
namespace {

/// Midpoints of the edges (degree 2) of a part of a triangle, edge e joining corners e and e + 1.
Mat3 midpoints(const Mat3& corners) {
  Mat3 result;
  for (int edge = 0; edge < 3; ++edge) result.col(edge) = (corners.col(edge) + corners.col((edge + 1) % 3)) / 2;
  return result;
}

using Block = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

/// block += weight N_a N_b matrix.
void add_products(const Vec3& shapes, double weight, const Mat3& matrix, Block& block) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) block.block<3, 3>(3 * a, 3 * b) += weight * shapes[a] * shapes[b] * matrix;
}

}  // namespace

SurfaceSupport::SurfaceSupport(Patch patch, Configured<Support> support, TissueMotion motion, std::string path)
    : patch_(std::move(patch)), support_(std::move(support)), anchor_{std::move(motion)}, path_(std::move(path)) {
  const std::vector<TrianglePart> parts = parts_of(patch_);
  faces_.resize(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    faces_[k].nodes = parts[k].of;
    faces_[k].shapes = midpoints(parts[k].corners);
    faces_[k].share = parts[k].share();
  }
}

void SurfaceSupport::share_out(const Share& share) {
  share_ = &share;
  if (share.is_whole()) return;
  std::erase_if(faces_, [&share](const Face& face) {
    return std::none_of(face.nodes.begin(), face.nodes.end(), [&share](int node) { return share.is_own(node); });
  });
  for (Face& face : faces_) face.counts = share.answers_for(face.nodes);
}

void SurfaceSupport::attach(const SparseMatrix& pattern) {
  std::vector<Triangle> triangles;
  for (const Face& face : faces_) triangles.push_back(face.nodes);
  scatter_ = ScatterMap(pattern, 3, std::span<const Triangle>(triangles));
  is_attached_ = true;
}

void SurfaceSupport::place(const Points& x) {
  for (Face& face : faces_) {
    const Triangle& t = face.nodes;
    Mat3 corners;
    corners << x.col(t[0]), x.col(t[1]), x.col(t[2]);
    const Vec3 twice = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    face.area = face.share * twice.norm() / 2;
    face.normal = twice.normalized();
    if (!placed_) face.corners = corners;
    face.axial.setZero();
    if (along_) face.axial = direction_on(corners, {(*along_)[t[0]], (*along_)[t[1]], (*along_)[t[2]]});
  }
  placed_ = true;
}

SupportTraction SurfaceSupport::at(const SupportStep& step, const AffineDisplacement& rest, const Face& face,
                                   int point) const {
  const Vec3 shapes = face.shapes.col(point);
  const auto mean = [&](const Points& values) -> Vec3 {
    return shapes[0] * values.col(face.nodes[0]) + shapes[1] * values.col(face.nodes[1]) +
           shapes[2] * values.col(face.nodes[2]);
  };
  const Vec3 imaged = face.corners * shapes;
  SupportPoint here{mean(step.displacement) - rest.at(imaged), mean(step.velocity), face.normal};
  if (step.acceleration != nullptr) here.acceleration = mean(*step.acceleration);
  here.axial = face.axial;
  here.position = imaged;
  here.time = step.time;
  return support_->at(here);
}

void SurfaceSupport::add(const SupportStep& step, VectorXd& force, SparseMatrix* tangent) const {
  if (support_.is_absent()) return;
  const AffineDisplacement rest = anchor_.at(step.time);
  const double acceleration_by_velocity = step.acceleration != nullptr ? 1 / step.advance : 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Face& face = faces_[k];
    Block block = Block::Zero();
    for (int point = 0; point < 3; ++point) {
      const SupportTraction response = at(step, rest, face, point);
      const Vec3 shapes = face.shapes.col(point);
      for (int a = 0; a < 3; ++a)
        force.segment<3>(3 * face.nodes[static_cast<std::size_t>(a)]) += face.area / 3 * shapes[a] * response.traction;
      if (tangent != nullptr)
        add_products(shapes, face.area / 3,
                     step.advance * response.stiffness + response.damping + acceleration_by_velocity * response.inertia,
                     block);
    }
    if (tangent != nullptr) scatter_.add(*tangent, k, block.data());
  }
}

void SurfaceSupport::add_stiffness(SparseMatrix& K) const {
  if (support_.is_absent()) return;
  int last = 0;
  for (const Face& face : faces_) last = std::max({last, face.nodes[0], face.nodes[1], face.nodes[2]});
  const Points still = Points::Zero(3, 1 + last);
  const SupportStep at_rest{still, still, 0, 0};
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    Block block = Block::Zero();
    for (int point = 0; point < 3; ++point)
      add_products(faces_[k].shapes.col(point), faces_[k].area / 3,
                   at(at_rest, AffineDisplacement{}, faces_[k], point).stiffness, block);
    scatter_.add(K, k, block.data());
  }
}

Vec3 SurfaceSupport::resultant(const SupportStep& step) const {
  Vec3 sum = Vec3::Zero();
  if (support_.is_absent()) return sum;
  const AffineDisplacement rest = anchor_.at(step.time);
  for (const Face& face : faces_)
    for (int point = 0; face.counts && point < 3; ++point) sum += face.area / 3 * at(step, rest, face, point).traction;
  if (share_ != nullptr) share_->team().sum({sum.data(), 3});
  return sum;
}

}  // namespace tether
