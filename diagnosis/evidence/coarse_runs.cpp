#include "diagnosis/evidence/coarse_runs.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/overlay.hpp"
#include "diagnosis/evidence/numerics.hpp"

namespace tether {
namespace {

constexpr int least_around = 12, least_along = 8;
/// Residual at which a step is coupled: it leaves out 4e-6 of what an effect does, and a quarter of the evaluations
/// (decision 93).
constexpr double coupled_to = 1e-4;

/// Half as many, but not fewer than a tube needs to be one; even. As many as there are where that is hardly fewer: what
/// they differ by then would say nothing of what is left.
int halved(int elements, int least) {
  constexpr double hardly = 1.3;
  const int half = std::max(elements / 2, std::min(elements, least)), even = half + half % 2;
  return elements >= hardly * even ? even : elements;
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
  const std::filesystem::path file = candidates.parent_path() / (beside_candidates(candidates, "coarse") + ".yaml");
  const CommonCase& common = given.file.common();
  const double step = longer_step(common.time), end = common.time.start + duration(common.time);
  std::vector<Overlay::Value> values{{"time.step", number_text(step)}};
  if (end > common.time.end + 1e-6 * step) values.push_back({"time.end", number_text(end)});
  if (given.mesh.source == "swept") {
    values.push_back({"mesh.swept.around", std::to_string(halved(given.mesh.swept.around, least_around))});
    values.push_back({"mesh.swept.along", std::to_string(halved(given.mesh.swept.along, least_along))});
  }
  const std::string tolerance = given.file.given("coupling.tolerance");
  if (tolerance.empty() || std::stod(tolerance) < coupled_to)
    values.push_back({"coupling.tolerance", number_text(coupled_to)});
  write_overlay(file, {candidates, common.name + "_coarse", common.titled(", coarser"), values});
  return file;
}

/// Of the directions of the mesh that are coarsened that which is least; where none is, the step's.
double coarser_by(const MeshCase& mesh) {
  constexpr double of_step = 2;
  if (mesh.source != "swept") return of_step;
  const auto ratio = [](int elements, int least) { return static_cast<double>(elements) / halved(elements, least); };
  const double around = ratio(mesh.swept.around, least_around), along = ratio(mesh.swept.along, least_along);
  const double least = std::min(around, along), most = std::max(around, along);
  return least > 1 ? least : most > 1 ? most : of_step;
}

bool has_coarser_mesh(const MeshCase& mesh) {
  return mesh.source == "swept" && halved(mesh.swept.around, least_around) < mesh.swept.around &&
         halved(mesh.swept.along, least_along) < mesh.swept.along;
}

MappedRuns::MappedRuns(std::unique_ptr<ModelRuns> runs, const LumenSurface& lumen, const LumenSurface& other,
                       std::string folder)
    : runs_(std::move(runs)), to_nodes_(lumen, other), folder_(std::move(folder)) {}

std::vector<FinishedMotion> MappedRuns::make(const std::vector<WantedRun>& wanted) {
  std::vector<WantedRun> elsewhere;
  for (const WantedRun& run : wanted) {
    const std::string name = run.folder.substr(run.folder.find('/') + 1);
    elsewhere.push_back({folder_ + "/" + name, run.values});
  }
  std::vector<FinishedMotion> motions = runs_->make(elsewhere);
  for (FinishedMotion& motion : motions)
    if (!motion.failed()) motion = to_nodes_(motion);
  return motions;
}

}  // namespace tether
