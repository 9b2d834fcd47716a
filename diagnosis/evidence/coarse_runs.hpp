#pragma once

#include <memory>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/model_runs.hpp"
#include "diagnosis/evidence/node_map.hpp"

namespace tether {

/// Writes the case of all candidates with a step twice as long, and of a swept mesh fewer elements around and along,
/// beside it: what each number does to first order is much the same, at a fraction of the cost.
std::filesystem::path write_coarse(const std::filesystem::path& candidates, const DiagnosedCase& given);

/// Runs of a coarser model of the same vessel, as the nodes of the model's own lumen move in them.
class CoarseRuns : public ModelRuns {
 public:
  /// runs: of the coarse model, whose lumen `other` is. The folders of the runs begin with `folder`.
  CoarseRuns(std::unique_ptr<ModelRuns> runs, const LumenSurface& lumen, const LumenSurface& other, std::string folder);

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
