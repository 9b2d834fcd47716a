#include <fmt/format.h>

#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

struct MisplacedFrame {
  ConcernedFrame frame;
  Vec3 offset{undefined, undefined, undefined};
  void declare(Fields& f) {
    frame.declare(f);
    f.point("offset", offset, dimension::length, "added to the frame's coordinates");
  }
};

/// The data are displaced, all of them or one frame.
class Displacement : public FaultOf<Displacement> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"misregistration", "The data are displaced as a whole"},
                                      .of_frame = {"misplaced_frame", "One frame is displaced"},
                                      .concerns = [](const Fallible& data) { return data.in_place; },
                                      .ruled_out_by_image = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    FaultColumns all{{}, data.normals.transpose()};
    for (const char* axis : {"x", "y", "z"})
      all.numbers.push_back({axis, std::string("displacement of the data in ") + axis, dimension::length});
    return all;
  }
  double allowed(const AllowanceCase& allowed, double noise) const override {
    return allowed.displacement.value_or(0.5 * noise);
  }
  double allowed_of_frame(const AllowanceCase& allowed) const override { return allowed.frame_displacement; }

  std::vector<Overlay::Value> take_off(const FoundFault& found) const override {
    const Vec3 by(found.number("x"), found.number("y"), found.number("z"));
    return {{"correction.displacement", list_text(vector_of(added_) - by)}};
  }
  void declare_correction(Fields& f, Dimension) override {
    f.numbers("displacement", added_, {3, dimension::length, range::any}, "added to the data's coordinates");
  }
  Points corrected(Points points) const override { return points.colwise() + vector_of(added_); }
  Vec3 uncorrected(const Vec3& point) const override { return point - vector_of(added_); }
  std::string note(const std::string& unit) const override {
    const Vec3 by = vector_of(added_);
    return by.isZero(0) ? "" : fmt::format("displaced by ({:.3g}, {:.3g}, {:.3g}) {}", by(0), by(1), by(2), unit);
  }

  void declare_made(Fields& f, Dimension) override { f.group("misplaced", made_, "a frame that is moved as a whole"); }
  void check_made(int frames, const std::string& where) const override {
    if (made_) made_->frame.check(frames, where);
  }
  void spoil(TriangleSurface& surface, const TriangleSurface&, int frame) const override {
    if (made_ && made_->frame.is(frame)) surface.points.colwise() += made_->offset;
  }

 private:
  std::vector<double> added_;
  std::optional<MisplacedFrame> made_;
};

}  // namespace

std::unique_ptr<Fault> displacement() {
  return std::make_unique<Displacement>();
}

}  // namespace tether::faults
