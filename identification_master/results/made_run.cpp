#include "identification_master/results/made_run.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(MadeRun);

}  // namespace tether
