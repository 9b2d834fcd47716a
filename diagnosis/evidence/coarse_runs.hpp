#pragma once

#include <memory>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/model_runs.hpp"
#include "diagnosis/evidence/node_map.hpp"

namespace tether {

/// Writes the case of all candidates with a step twice as long, coupled less exactly, and of a swept mesh fewer
/// elements around and along, beside it: what each number does to first order is much the same, at a fraction of the
/// cost.
std::filesystem::path write_coarse(const std::filesystem::path& candidates, const DiagnosedCase& given);

/// How many times as coarse that model is.
double coarser_by(const MeshCase& mesh);
/// Whether it is coarser around and along: not of a mesh that is about as coarse as one may be, or that is read.
bool has_coarser_mesh(const MeshCase& mesh);

/// Runs of the same vessel on another mesh, as the nodes of the model's own lumen move in them.
class MappedRuns : public ModelRuns {
 public:
  /// runs: of the model whose lumen `other` is. The folders of the runs begin with `folder`.
  MappedRuns(std::unique_ptr<ModelRuns> runs, const LumenSurface& lumen, const LumenSurface& other, std::string folder);

  const std::vector<protocol::ParameterInfo>& parameters() const override { return runs_->parameters(); }
  std::vector<std::string> columns() const override { return runs_->columns(); }
  std::vector<FinishedMotion> make(const std::vector<WantedRun>& wanted) override;
  RunsCost cost() const override { return runs_->cost(); }

 private:
  std::unique_ptr<ModelRuns> runs_;
  NodeMap to_nodes_;
  std::string folder_;
};

}  // namespace tether
