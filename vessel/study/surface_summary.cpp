#include "vessel/study/surface_summary.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(SurfaceSummary);

}  // namespace tether
