#include "observation_manager/measurements/faults/registry.hpp"

#include "observation_manager/measurements/faults/fault.hpp"

namespace tether {

namespace faults {
std::unique_ptr<Fault> clipped_ends(), displacement(), rotation(), cropped(), bias(), blur(), lag(), lost(),
    value_scale(), value_offset(), value_lag();
}

std::span<const MakeFault> data_faults() {
  static constexpr MakeFault all[] = {faults::clipped_ends, faults::displacement, faults::rotation, faults::cropped,
                                      faults::bias,         faults::blur,         faults::lag,      faults::lost,
                                      faults::value_scale,  faults::value_offset, faults::value_lag};
  return all;
}

}  // namespace tether
