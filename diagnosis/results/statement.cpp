#include "diagnosis/results/statement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tether {
namespace {

std::string ambiguous_sentence(const Statement& statement) {
  std::vector<std::string> groups;
  for (const auto& group : statement.alike) groups.push_back(fmt::format("{}", fmt::join(group, " from ")));
  std::string text = fmt::format("AMBIGUOUS: these data cannot tell {}", fmt::join(groups, ", nor "));
  if (!statement.effects.empty()) text += fmt::format("; beside it {}", fmt::join(statement.effects, " and "));
  if (!statement.wrong_data.empty())
    text += fmt::format("; THE DATA are off: {}", fmt::join(statement.wrong_data, " and "));
  if (!statement.coarse_numerics.empty())
    text += fmt::format("; THE NUMERICS are too coarse: {}", fmt::join(statement.coarse_numerics, " and "));
  return text;
}

}  // namespace

void Statement::add(CandidateKind kind, std::string text) {
  (kind == CandidateKind::data       ? wrong_data
   : kind == CandidateKind::numerics ? coarse_numerics
                                     : effects)
      .push_back(std::move(text));
}

std::string sentence_of(Verdict verdict, const Statement& statement, bool doubtful) {
  if (verdict == Verdict::ambiguous) return ambiguous_sentence(statement);
  const std::string wrong = fmt::format("{}", fmt::join(statement.wrong_data, "; and ")),
                    coarse = fmt::format("{}", fmt::join(statement.coarse_numerics, "; and "));
  if (statement.effects.empty() && wrong.empty())
    return fmt::format("THE NUMERICS are too coarse, no effect is missing: {}", coarse);
  std::string text =
      statement.effects.empty()
          ? fmt::format("THE DATA are off{}: {}",
                        doubtful ? ", and more than chance is left beside" : ", the model lacks nothing beside", wrong)
          : fmt::format("MISSING: {}{}{}", fmt::join(statement.effects, "; and "),
                        wrong.empty() ? "" : "; and THE DATA are off: ", wrong);
  if (!coarse.empty()) text += "; and THE NUMERICS are too coarse: " + coarse;
  return text;
}

}  // namespace tether
