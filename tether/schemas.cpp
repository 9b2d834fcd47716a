#include "tether/schemas.hpp"

#include <algorithm>
#include <iostream>

#include "batch/job.hpp"
#include "common/base/error.hpp"
#include "common/catalogue/effects_list.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/compared_wall.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "diagnosis/results/noise.hpp"
#include "fluid/windkessels/outlets_result.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "identification_master/results/made_run.hpp"
#include "solid/results/rest_state.hpp"
#include "twin/score.hpp"
#include "vessel/model/model_quality.hpp"
#include "vessel/ring/tracked_ring.hpp"
#include "vessel/study/surface_summary.hpp"

namespace tether {
namespace {

template <class Result>
std::string schema() {
  return schema_of<Result>(Result::type_name);
}

}  // namespace

const std::vector<ResultSchema>& result_schemas() {
  static const std::vector<ResultSchema> all{
      {"summary.json", schema<RunSummary>},
      {"comparison.json", schema<ComparisonResult>},
      {"wall.json", schema<ComparedWall>},
      {"diagnosis.json", schema<Diagnosis>},
      {"explain.json", schema<Explanation>},
      {"steps.json", schema<StepsMade>},
      {"force.json", schema<ForceFound>},
      {"estimate.json", schema<Estimate>},
      {"run.json", schema<MadeRun>},
      {"score.json", schema<Score>},
      {"effects.json", schema<EffectsList>},
      {"noise.json", schema<NoiseMeasurements>},
      {"surface.json", schema<SurfaceSummary>},
      {"quality.json", schema<ModelQuality>},
      {"outlets.json", schema<FittedOutlets>},
      {"ring.json", schema<TrackedRing>},
      {"rest.json", schema<RestState>},
      {"job.json", schema<Job>},
  };
  return all;
}

int print_schema(int argc, char** argv) {
  const std::string file = argc > 0 ? argv[0] : "";
  if (file == "--help") {
    std::cout << "tether schema [FILE]: prints the JSON schema of a file of results, such as diagnosis.json; without a "
                 "name, the names of all\n";
    return exit_done;
  }
  for (const ResultSchema& one : result_schemas())
    if (file.empty())
      std::cout << one.file << "\n";
    else if (file == one.file)
      std::cout << one.text();
  const bool known = std::any_of(result_schemas().begin(), result_schemas().end(),
                                 [&](const ResultSchema& one) { return file == one.file; });
  if (file.empty() || known) return exit_done;
  std::cerr << "tether schema: there is none of " << file << "; tether schema lists all\n";
  return exit_input_wrong;
}

}  // namespace tether
