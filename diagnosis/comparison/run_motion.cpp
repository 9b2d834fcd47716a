#include "diagnosis/comparison/run_motion.hpp"

#include <memory>

#include "common/io/lumen_motion.hpp"

namespace tether {

RunMotion stored_motion(const std::filesystem::path& folder) {
  const auto stored = std::make_shared<const LumenMotion>(folder / "lumen.motion");
  return {stored->times().front(), stored->times().back(), stored->imaged(),
          [stored](double time) { return stored->at(time); }};
}

}  // namespace tether
