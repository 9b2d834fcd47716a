#include "diagnosis/explanation/path_findings.hpp"

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {
namespace {

bool are_the_same(const Finding& one, const Finding& other) {
  return name_of(one) == name_of(other);
}

bool is_among(const std::vector<Finding>& all, const Finding& finding) {
  return std::any_of(all.begin(), all.end(), [&](const Finding& other) { return are_the_same(other, finding); });
}

/// Takes a finding out of those that are left to be told: its text as it was found in the end, or roughly if it was
/// not.
std::string taken_text(std::vector<Finding>& left, const Finding& finding) {
  const auto found =
      std::find_if(left.begin(), left.end(), [&](const Finding& other) { return are_the_same(other, finding); });
  if (found == left.end()) return rough_text_of(finding);
  std::string text = text_of(*found);
  left.erase(found);
  return text;
}

std::vector<std::string> rivals_of(const Finding& finding, const Diagnosis& diagnosis) {
  std::vector<std::string> all;
  for (const Finding& other : diagnosis.effects)
    if (other.rival && other.group && other.group == finding.group) all.push_back(rough_text_of(other));
  return all;
}

/// What the data cannot tell apart, as identified where it was; then what was found beside it.
Statement with_rivals(const ExplanationPath& path) {
  Statement statement;
  std::vector<Finding> left = found_on(path);
  for (const Diagnosis* diagnosis : upheld_diagnoses(path))
    for (const Finding& finding : diagnosis->effects) {
      if (!finding.accepted) continue;
      std::vector<std::string> alike{taken_text(left, finding)};
      for (std::string& rival : rivals_of(finding, *diagnosis)) alike.push_back(std::move(rival));
      if (alike.size() > 1)
        statement.alike.push_back(std::move(alike));
      else
        statement.add(finding.kind, std::move(alike.front()));
    }
  for (const Finding& finding : left) statement.add(finding.kind, text_of(finding));
  return statement;
}

}  // namespace

std::vector<Finding> found_on(const ExplanationPath& path) {
  std::vector<Finding> all;
  const auto add = [&](const std::vector<Finding>& some) {
    for (const Finding& finding : some) {
      const auto same =
          std::find_if(all.begin(), all.end(), [&](const Finding& f) { return are_the_same(f, finding); });
      if (same == all.end())
        all.push_back(finding);
      else
        *same = finding;  // as it is beside what was found since
    }
  };
  for (std::size_t i = 0; i <= path.best; ++i) {
    const PathModel& model = path.models[i];
    if (!model.told.accepted) continue;
    add(model.told.added);
    if (model.diagnosis) add(accepted_of(*model.diagnosis, true));
  }
  return all;
}

const Diagnosis& last_diagnosis(const ExplanationPath& path) {
  for (std::size_t i = path.best + 1; i-- > 0;)
    if (path.models[i].diagnosis) return *path.models[i].diagnosis;
  throw run_error("no model of this explanation was diagnosed");
}

std::vector<const Diagnosis*> upheld_diagnoses(const ExplanationPath& path) {
  std::vector<const Diagnosis*> all;
  for (std::size_t i = 0; i <= path.best; ++i)
    if (path.models[i].diagnosis && (i < path.best || !path.was_last_refused()))
      all.push_back(&*path.models[i].diagnosis);
  return all;
}

std::vector<Finding> frames_left_out(const ExplanationPath& path) {
  std::vector<Finding> all;
  for (std::size_t i = 0; i < path.best; ++i)
    if (path.models[i].diagnosis)
      for (const Finding& error : accepted_of(*path.models[i].diagnosis, true))
        if (error.frame) all.push_back(error);
  return all;
}

std::vector<Finding> all_candidates(const ExplanationPath& path) {
  std::vector<Finding> all = found_on(path);
  for (std::size_t i = path.best + 1; i-- > 0;)
    if (path.models[i].diagnosis)
      for (const Finding& finding : path.models[i].diagnosis->effects)
        if (!is_among(all, finding)) all.push_back(finding);
  return all;
}

Statement statement_of(const ExplanationPath& path) {
  if (verdict_of(path) == Verdict::ambiguous) return with_rivals(path);
  Statement statement;
  for (const Finding& finding : found_on(path)) statement.add(finding.kind, text_of(finding));
  return statement;
}

}  // namespace tether
