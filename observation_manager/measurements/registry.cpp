#include "observation_manager/measurements/registry.hpp"

namespace tether {

std::span<const MeasurementKind* const> measurement_kinds() {
  static const MeasurementKind* const all[] = {&kinds::surfaces, &kinds::contours, &kinds::traces, &kinds::velocities};
  return all;
}

}  // namespace tether
