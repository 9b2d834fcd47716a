#pragma once

#include <functional>
#include <memory>

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/evidence/model_runs.hpp"

namespace tether {

/// Runs of a model that may get more effects. What makes them is begun anew with all effects when the next run is
/// wanted; runs made before stay what they are, since effects that are absent do nothing.
class GrowingRuns : public ModelRuns {
 public:
  /// What makes runs of the model with these effects; grown: how often it has got more.
  using Make = std::function<std::unique_ptr<ModelRuns>(const std::vector<PlacedEffect>& effects, int grown)>;
  GrowingRuns(std::vector<PlacedEffect> effects, Make make);

  void add(const std::vector<PlacedEffect>& more);
  /// What makes them ends until more are wanted.
  void rest();

  const std::vector<protocol::ParameterInfo>& parameters() const override { return now().parameters(); }
  std::vector<std::string> columns() const override { return now().columns(); }
  std::vector<FinishedMotion> make(const std::vector<WantedRun>& wanted) override { return now().make(wanted); }
  RunsCost cost() const override;

 private:
  ModelRuns& now() const;

  std::vector<PlacedEffect> effects_;
  int grown_ = 0;
  Make make_;
  mutable std::unique_ptr<ModelRuns> now_;
  RunsCost before_;  ///< of those that have ended
};

}  // namespace tether
