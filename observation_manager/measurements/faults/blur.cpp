#include "observation_manager/measurements/faults/fault.hpp"

namespace tether::faults {
namespace {

/// An unsharp image, which no correction sharpens. A twin's image is unsharp by its own field, twin.image.blur.
class Blur : public FaultOf<Blur> {
 public:
  const FaultDeclaration& declaration() const override {
    static const FaultDeclaration all{.of_all = {"blur", "The image is blurred, which draws a curved surface inward"},
                                      .concerns = [](const Fallible& data) { return data.in_threshold; },
                                      .ruled_out_by_image = true};
    return all;
  }

  FaultColumns columns(const SourceData& data) const override {
    return {{{"variance", "of the image's blur", dimension::area, {}, 0}}, -0.5 * data.curvatures};  // (D.17)
  }
};

}  // namespace

std::unique_ptr<Fault> blur() {
  return std::make_unique<Blur>();
}

}  // namespace tether::faults
