#include "diagnosis/evidence/coarse_runs.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/overlay.hpp"

namespace tether {
namespace {

constexpr int least_around = 12, least_along = 8;

/// Half as many, but not fewer than a tube needs to be one; even.
int halved(int elements, int least) {
  const int half = std::max(elements / 2, std::min(elements, least));
  return half + half % 2;
}

/// Of the model's run, whose last step may end behind time.end: data may lie there.
double duration(const TimeCase& time) {
  return time.steps() * time.step;
}

/// As many steps as fit, none longer than twice the model's.
double longer_step(const TimeCase& time) {
  return duration(time) / std::ceil(duration(time) / (2 * time.step) - 1e-6);
}

}  // namespace

std::filesystem::path write_coarse(const std::filesystem::path& candidates, const DiagnosedCase& given) {
  std::string name = candidates.stem().string();
  name.replace(0, std::string("candidates").size(), "coarse");
  const std::filesystem::path file = candidates.parent_path() / (name + ".yaml");
  const CommonCase& common = given.file.common();
  const double step = longer_step(common.time), end = common.time.start + duration(common.time);
  std::vector<Overlay::Value> values{{"time.step", number_text(step)}};
  if (end > common.time.end + 1e-6 * step) values.push_back({"time.end", number_text(end)});
  if (given.mesh.source == "swept") {
    values.push_back({"mesh.swept.around", std::to_string(halved(given.mesh.swept.around, least_around))});
    values.push_back({"mesh.swept.along", std::to_string(halved(given.mesh.swept.along, least_along))});
  }
  write_overlay(file, {candidates, common.name + "_coarse", common.title + ", coarser", values});
  return file;
}

CoarseRuns::CoarseRuns(std::unique_ptr<ModelRuns> runs, const LumenSurface& lumen, const LumenSurface& other,
                       std::string folder)
    : runs_(std::move(runs)), to_nodes_(lumen, other), folder_(std::move(folder)) {}

std::vector<FinishedMotion> CoarseRuns::make(const std::vector<WantedRun>& wanted) {
  std::vector<WantedRun> coarse;
  for (const WantedRun& run : wanted) {
    const std::string name = run.folder.substr(run.folder.find('/') + 1);
    coarse.push_back({folder_ + "/" + name, run.values});
  }
  std::vector<FinishedMotion> motions = runs_->make(coarse);
  for (FinishedMotion& motion : motions)
    if (!motion.failed()) motion = to_nodes_(motion);
  return motions;
}

}  // namespace tether
