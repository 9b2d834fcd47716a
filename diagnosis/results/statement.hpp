#pragma once

#include <string>
#include <vector>

#include "diagnosis/results/finding.hpp"
#include "diagnosis/results/verdict.hpp"

namespace tether {

/// What was found, each with its amount, as people read it; of which the first sentence is made.
struct Statement {
  static constexpr const char* type_name = "statement";
  std::vector<std::vector<std::string>> alike;
  std::vector<std::string> effects, wrong_data, coarse_numerics;

  static void fields(auto& self, auto&& field) {
    field("alike", self.alike, "groups of what these data cannot tell apart, the one that fits best first");
    field("effects", self.effects, "what the model lacks or has wrong");
    field("wrong_data", self.wrong_data, "errors of the measurements");
    field("coarse_numerics", self.coarse_numerics, "errors of mesh or time step");
  }
  void add(CandidateKind kind, std::string text);
  bool empty() const { return alike.empty() && effects.empty() && wrong_data.empty() && coarse_numerics.empty(); }
};

/// "MISSING: ...", "AMBIGUOUS: these data cannot tell A from B, nor C from D; beside it E; THE DATA are off: F; THE
/// NUMERICS are too coarse: G". doubtful: more than chance is left. For verdicts that name what was found: missing and
/// ambiguous.
std::string sentence_of(Verdict verdict, const Statement& statement, bool doubtful);

}  // namespace tether
