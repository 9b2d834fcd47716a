#include "fsi_master/results/run_summary.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(RunSummary);

}  // namespace tether
