#include "batch/job.hpp"
#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(Job);

}  // namespace tether
