#include "diagnosis/explanation/path_sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "diagnosis/explanation/path_findings.hpp"

namespace tether {
namespace {

using Sentences = std::vector<std::string>;

/// "with contact at spine: held-out data do not confirm it", the last model that was tried.
std::string refused_model(const ExplanationPath& path, const char* between) {
  const ExplainedModel& last = path.models.back().told;
  return last.name + between + reason_of(last.objection);
}

/// An error of the data or the numerics is told by the diagnosis that found nothing beside it.
std::string missing_sentence(const ExplanationPath& path) {
  const Statement statement = statement_of(path);
  return statement.effects.empty() ? headline_of(last_diagnosis(path))
                                   : sentence_of(Verdict::missing, statement, false);
}

std::string headline_of(const ExplanationPath& path) {
  const Diagnosis& last = last_diagnosis(path);
  switch (verdict_of(path)) {
    case Verdict::missing:
      return missing_sentence(path);
    case Verdict::ambiguous:
      return sentence_of(Verdict::ambiguous, statement_of(path), false);
    default:
      break;
  }
  const bool is_refused = path.was_last_refused() && last.verdict != Verdict::not_in_catalogue;
  const std::string open = is_refused ? "UNDECIDED: " + refused_model(path, " stands out, but ") : headline_of(last);
  std::vector<std::string> found;
  for (const Finding& finding : found_on(path)) found.push_back(text_of(finding));
  return found.empty() ? open : fmt::format("{}; beside {}", open, fmt::join(found, " and "));
}

std::string held_out_sentence(const ExplanationPath& path) {
  const ExplainedModel &first = path.models.front().told, &last = path.models[path.best].told;
  if (!first.held_out || !last.held_out)
    return fmt::format("Held-out data: {:.0f} % less misfit ({:.0f} .. {:.0f})", 100 * path.held_out->value,
                       100 * path.held_out->lower, 100 * path.held_out->upper);
  return fmt::format(
      "Held-out frames: {:.2g} mm away from the model as given, {:.2g} mm from the one with what was added: {:.0f} % "
      "less "
      "({:.0f} .. {:.0f}); {:.1f} times the noise is left",
      path.millimetres * first.held_out->length, path.millimetres * last.held_out->length, 100 * path.held_out->value,
      100 * path.held_out->lower, 100 * path.held_out->upper, last.held_out->in_noise);
}

void append(Sentences& all, const Sentences& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What the diagnoses say beside their verdicts, the last one's first.
void add_remarks(Sentences& all, const ExplanationPath& path) {
  const Diagnosis& last = last_diagnosis(path);
  append(all, remarks_on(last, HeldOutGain::left_out));
  for (const Diagnosis* diagnosis : upheld_diagnoses(path))
    if (diagnosis != &last) append(all, look_alike_sentences(*diagnosis));
  const bool is_told = verdict_of(path) == Verdict::undecided;  // by the first sentence
  if (last.verdict == Verdict::undecided && !found_on(path).empty() && !is_told)
    all.push_back("Beside what was found: " + open_question_of(last));
}

}  // namespace

Sentences sentences_of(const ExplanationPath& path) {
  Sentences all{headline_of(path)};
  if (path.held_out && path.best > 0) all.push_back(held_out_sentence(path));
  if (corrected_case(path)) all.push_back("Is it so? Then explain the case with these errors taken off the data");
  for (const std::string& sentence : path.failure) all.push_back("The model as given: " + sentence);
  add_remarks(all, path);
  for (const Finding& frame : frames_left_out(path))
    all.push_back("Wrong, and left out where values were found: " + name_of(frame));
  append(all, path.odd_frames);
  if (path.was_last_refused()) all.push_back("Tried and not kept: " + refused_model(path, ": "));
  if (path.force) append(all, path.force->sentences);
  return all;
}

}  // namespace tether
