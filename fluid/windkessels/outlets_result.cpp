#include "fluid/windkessels/outlets_result.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(FittedOutlets);

}  // namespace tether
