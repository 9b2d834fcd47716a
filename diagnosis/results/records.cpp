#include "common/io/record_json.ipp"
#include "diagnosis/results/compared_wall.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/diagnosis.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "diagnosis/results/noise.hpp"

namespace tether {

TETHER_RECORD(ComparedWall);
TETHER_RECORD(ComparisonResult);
TETHER_RECORD(Diagnosis);
TETHER_RECORD(Explanation);
TETHER_RECORD(StepsMade);
TETHER_RECORD(ForceFound);
TETHER_RECORD(NoiseMeasurements);

}  // namespace tether
