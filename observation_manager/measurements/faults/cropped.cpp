#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

struct CroppedFrame {
  ConcernedFrame frame;
  Vec3 point{undefined, undefined, undefined}, normal{undefined, undefined, undefined};
  void declare(Fields& f) {
    frame.declare(f);
    f.point("point", point, dimension::length, "of the plane");
    f.direction("normal", normal, "of the plane: what lies on this side is cut off");
  }
};

/// A frame shows a part of the vessel only.
class Cropped : public FaultOf<Cropped> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.concerns = [](const Fallible& data) { return data.in_place; }};
    return all;
  }

  void declare_made(Fields& f, Dimension) override { f.group("cropped", made_, "a frame that shows a part only"); }
  void check_made(int frames, const std::string& where) const override {
    if (made_) made_->frame.check(frames, where);
  }
  void spoil(TriangleSurface& surface, const TriangleSurface&, int frame) const override {
    if (made_ && made_->frame.is(frame))
      surface = part_where(surface, [&](const Vec3& x) { return (x - made_->point).dot(made_->normal) <= 0; });
  }

 private:
  std::optional<CroppedFrame> made_;
};

}  // namespace

std::unique_ptr<Fault> cropped() {
  return std::make_unique<Cropped>();
}

}  // namespace tether::faults
