#include "vessel/ring/tracked_ring.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(TrackedRing);

}  // namespace tether
