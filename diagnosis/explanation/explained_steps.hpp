#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "common/config/input_watch.hpp"
#include "diagnosis/results/explanation.hpp"

namespace tether {

/// Makes the steps of an explanation, and leaves out those that were made before from the same case and files and whose
/// results are as they were left: steps.json in the output folder remembers.
class ExplainedSteps {
 public:
  /// inputs: of the case that is explained, of which no step may be made once one of them is written.
  ExplainedSteps(std::filesystem::path output, const InputWatch& inputs, bool quiet);

  /// Runs a verb on a case, which leaves `result` in OUTPUT/folder. `act` is told whether this very step was begun
  /// before and did not end: a checkpoint in the folder is its own then; others' are removed. asked: a hash of what it
  /// depends on beside the case. Throws RunError if it fails.
  void make(const std::string& title, const std::filesystem::path& case_file, const std::string& folder,
            const std::string& result, const std::function<void(bool was_begun)>& act, std::uint64_t asked = 0);

  std::vector<ExplainedStep> all() const;

 private:
  void save() const;
  /// The step as it was made before, if its results are there as it left them. Of damaged ones nothing is kept.
  const StepMade* kept(const ExplainedStep& step) const;

  std::filesystem::path output_;
  const InputWatch& inputs_;
  bool quiet_;
  std::vector<StepMade> before_, done_;
};

}  // namespace tether
