#pragma once

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/explanation/path.hpp"
#include "diagnosis/search/diagnosis.hpp"

namespace tether {

/// A case whose results go into a folder.
struct ExplanationTask {
  std::filesystem::path case_file, folder;
  bool resume = false;  ///< from the checkpoint that is there
};

/// What an explanation has others do. Each leaves its results in the task's folder; throws ToldFailure, RunError.
class ExplanationWork {
 public:
  virtual ~ExplanationWork() = default;
  virtual void compare(const ExplanationTask& task) = 0;  ///< comparison.json, after a run
  /// diagnosis.json, suggested.yaml. settings: what came of the path so far.
  virtual void diagnose(const ExplanationTask& task, const DiagnosisSettings& settings) = 0;
  virtual void identify(const ExplanationTask& task) = 0;  ///< estimate.json, identified.yaml
};

/// Walks the whole path: compares, finds what the model lacks, adds it, identifies it, compares on held-out data, and
/// again until there is a verdict. What was done before into the same folder is kept. Throws RunError.
ExplanationPath explain(const DiagnosedCase& given, const std::filesystem::path& output, ExplanationWork& work,
                        bool quiet);

}  // namespace tether
