#pragma once

#include "diagnosis/explanation/path.hpp"

/// What a path has found, for its verdict and its sentences.
namespace tether {

/// All that was added on the way to the best model, and errors of data and numerics that were named.
std::vector<Finding> found_on(const ExplanationPath& path);

/// The last diagnosis that was made of an accepted model. There is one.
const Diagnosis& last_diagnosis(const ExplanationPath& path);

/// Diagnoses on the way to the best model, but not one whose finding was not confirmed.
std::vector<const Diagnosis*> upheld_diagnoses(const ExplanationPath& path);

/// Single frames that diagnoses found wrong, if the path went on without them.
std::vector<Finding> frames_left_out(const ExplanationPath& path);

/// What was found first, then the other candidates of all diagnoses, the last one's first.
std::vector<Finding> all_candidates(const ExplanationPath& path);

/// What was found, with identified amounts where there are.
Statement statement_of(const ExplanationPath& path);

}  // namespace tether
