#include "common/mesh/locator.hpp"
#include "common/mesh/topology.hpp"
#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// Nothing is segmented near the ends.
class ClippedEnds : public FaultOf<ClippedEnds> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.concerns = [](const Fallible& data) { return data.in_place; }};
    return all;
  }

  void declare_made(Fields& f, Dimension) override {
    f.number("clipped_ends", distance_, dimension::length, range::not_negative,
             "nothing is segmented within this distance of the vessel's ends");
  }
  void spoil(TriangleSurface& surface, const TriangleSurface& truth, int) const override {
    std::vector<int> ends;
    for (const auto& rim : rims(truth.triangles)) ends.insert(ends.end(), rim.begin(), rim.end());
    if (distance_ == 0 || ends.empty()) return;
    const PointLocator locator(truth.points(Eigen::all, ends));
    surface = part_where(surface, [&](const Vec3& x) { return locator.nearest(x).distance >= distance_; });
  }

 private:
  double distance_ = 0;
};

}  // namespace

std::unique_ptr<Fault> clipped_ends() {
  return std::make_unique<ClippedEnds>();
}

}  // namespace tether::faults
