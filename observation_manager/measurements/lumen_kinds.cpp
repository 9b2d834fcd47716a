#include "observation_manager/measurements/lumen_kinds.hpp"

namespace tether {

std::span<const LumenKind> lumen_kinds() {
  static const LumenKind all[] = {{kinds::surfaces, load_surfaces}, {kinds::contours, load_contours}};
  return all;
}

}  // namespace tether
