#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

using Index = Eigen::Index;

/// The axes that the data show a rotation about: a round tube does not, about its own axis.
std::vector<Index> seen_axes(const MatrixXd& turned) {
  constexpr double hardly_seen = 0.03;  // of the best seen axis's squares
  const Vec3 squares = turned.colwise().squaredNorm();
  std::vector<Index> seen;
  for (Index axis = 0; axis < 3; ++axis)
    if (squares(axis) > hardly_seen * squares.maxCoeff()) seen.push_back(axis);
  return seen;
}

/// The data are turned about their middle. Beside a rotation that is known, none is taken off.
class Rotation : public FaultOf<Rotation> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"misrotation", "The data are turned as a whole, about their middle"},
                                      .concerns = [](const Fallible& data) { return data.in_place; },
                                      .ruled_out_by_image = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    constexpr double far = 0.35;  // 20 degrees: beyond, first order says nothing
    MatrixXd turned(data.places.cols(), 3);
    for (Index i = 0; i < turned.rows(); ++i)
      turned.row(i) = Vec3(data.places.col(i) - data.middle).cross(Vec3(data.normals.col(i))).transpose();
    const std::vector<Index> seen = seen_axes(turned);
    FaultColumns all{{}, turned(Eigen::all, seen)};
    for (const Index axis : seen) {
      const std::string name(1, "xyz"[axis]);
      all.numbers.push_back({"about_" + name, "rotation of the data about " + name, dimension::none, "rad", -far, far});
    }
    return all;
  }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    if (!vector_of(angle_).isZero()) return {};
    const Vec3 by(found.number("about_x"), found.number("about_y"), found.number("about_z"));
    return {{"correction.rotation", list_text(-by)}, {"correction.about", list_text(found.middle)}};
  }
  void declare_correction(Fields& f, Dimension) override {
    f.numbers("rotation", angle_, {3, dimension::none, range::any},
              "axis times angle in radians by which the data are turned, before they are displaced");
    f.numbers("about", about_, {3, dimension::length, range::any},
              "point about which they are turned; absent: 0, 0, 0");
    constexpr double eighth_of_a_turn = 0.786;
    f.check(vector_of(angle_).norm() < eighth_of_a_turn, "rotation", "must be below 45 degrees; it is in radians");
  }
  Points corrected(Points points) const override {
    const Vec3 middle = vector_of(about_);
    return vector_of(angle_).norm() > 0 ? Points((turn() * (points.colwise() - middle)).colwise() + middle) : points;
  }
  Vec3 uncorrected(const Vec3& point) const override {
    const Vec3 middle = vector_of(about_);
    return vector_of(angle_).norm() > 0 ? Vec3(turn().transpose() * (point - middle) + middle) : point;
  }
  std::string note(const std::string&) const override {
    const double angle = vector_of(angle_).norm();
    return angle > 0 ? fmt::format("turned by {:.3g} degrees", angle * 180 / std::numbers::pi) : "";
  }

 private:
  Eigen::Matrix3d turn() const {
    const Vec3 angle = vector_of(angle_);
    return Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix();
  }
  std::vector<double> angle_, about_;
};

}  // namespace

std::unique_ptr<Fault> rotation() {
  return std::make_unique<Rotation>();
}

}  // namespace tether::faults
