#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/results/diagnosis.hpp"

namespace tether {
namespace {

/// Of an attempt, or of an alternative of the table.
std::string name_of(const auto& named) {
  Finding finding;
  finding.name = named.name;
  finding.parameter = named.parameter;
  finding.where = named.where;
  return tether::name_of(finding);
}

bool any_accepted(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), [](const Finding& f) { return f.accepted; });
}

std::string where_left(const LackOfFitFound& lack) {
  const std::string time = lack.worst_time ? fmt::format("at {:.3g} s", *lack.worst_time) : "over the beat";
  const char* form = lack.worst_form == PatternForm::end_to_end ? " (inlet end, against the outlet end)"
                     : lack.worst_form == PatternForm::ends     ? " (both ends, against the middle)"
                                                                : "";
  return fmt::format("{}{}, {}: the model lies too far {} ({:.1f} sigma)", lack.worst_region, form, time,
                     lack.worst_z < 0 ? "outward" : "inward", std::abs(lack.worst_z));
}

std::string where_left(const Diagnosis& diagnosis) {
  return diagnosis.lack_of_fit.after ? where_left(*diagnosis.lack_of_fit.after) : "no region is known";
}

std::string refusal_text(const Attempt& attempt) {
  return fmt::format("{} stands out, but {}", name_of(attempt), attempt.reason);
}

std::string nothing_missing_sentence(const Diagnosis& diagnosis) {
  return fmt::format(
      "NOTHING MISSING: no candidate explains {}, and what is left is within the noise and the errors allowed",
      diagnosis.path.empty()
          ? "more than chance"
          : fmt::format("enough (the best, {}, might be more than chance)", name_of(diagnosis.path.front())));
}

std::string percent_of(double probability) {
  if (probability > 0.995) return "above 99 %";
  return probability < 0.005 ? "below 1 %" : fmt::format("{:.0f} %", 100 * probability);
}

/// answer: what it is asked for.
std::string split_sentence(const FurtherData& best, const char* answer) {
  if (best.tells)
    return fmt::format("Measuring {} would {} (chance {}; {})", best.measurement, answer, percent_of(best.probability),
                       best.assuming);
  return fmt::format("Of the measurements that were weighed none would {}. The best is {} (chance {}; {})", answer,
                     best.measurement, percent_of(best.probability), best.assuming);
}

std::string held_out_sentence(const Gain& gain) {
  const bool is_worse = gain.value < 0;
  const double sign = is_worse ? -100 : 100;
  return fmt::format(
      "Held-out frames: {:.0f} % {} distance ({:.0f} .. {:.0f}) with it, {:.2g} times the noise instead of {:.2g}",
      sign * gain.value, is_worse ? "more" : "less", sign * (is_worse ? gain.upper : gain.lower),
      sign * (is_worse ? gain.lower : gain.upper), gain.after, gain.before);
}

std::vector<std::string> accepted_texts(const Diagnosis& diagnosis) {
  std::vector<std::string> all;
  for (const Finding& finding : diagnosis.effects)
    if (finding.accepted) all.push_back(text_of(finding));
  return all;
}

/// "misregistration at ct, x -0.12 cm"; "solid.material.young, 3e+06 g/(cm s2)".
std::string size_of(const StrainedError& error) {
  if (!error.value) return error.name;
  const std::string number = error.number && *error.number != error.name ? *error.number + " " : "";
  return fmt::format("{}, {}{:.2g}{}", error.name, number, *error.value, error.unit == "1" ? "" : " " + error.unit);
}

std::string strained_sentence(const Diagnosis& diagnosis) {
  std::vector<std::string> all;
  for (const StrainedError& error : diagnosis.strained_errors)
    all.push_back(fmt::format("{} ({:.1f} times the deviation that is allowed)", size_of(error), error.deviations));
  return fmt::format("Errors that are allowed would have to be large, see to them: {}", fmt::join(all, "; "));
}

/// Runs of `other` fit worse: where the model is wrong in more than one way, that decides less than the numbers say.
bool does_much_the_same(const Finding& accepted, const Finding& other) {
  return !other.accepted && !other.rival && other.confirmed_by_runs && other.group && other.group == accepted.group;
}

/// Empty if there is none.
std::string look_alike_sentence(const Diagnosis& diagnosis, const Finding& accepted) {
  std::vector<std::string> alike;
  for (const Finding& other : diagnosis.effects)
    if (does_much_the_same(accepted, other))
      alike.push_back(fmt::format("{} ({:.0f} less)", name_of(other), accepted.misfit_removed - other.misfit_removed));
  if (alike.empty()) return "";
  return fmt::format("There is what does much the same as {}: its runs remove {:.0f} of the misfit, those of {}",
                     name_of(accepted), accepted.misfit_removed, fmt::join(alike, ", of "));
}

bool is_same(const Alternative& member, const Finding& finding) {
  return finding.name == member.name && finding.parameter == member.parameter && finding.where == member.where;
}

constexpr double told = 0.02;  ///< a probability below which it would be told from what was found

bool has(const AlternativeGroup& group, const Finding& finding) {
  return std::any_of(group.members.begin(), group.members.end(),
                     [&](const Alternative& member) { return is_same(member, finding); });
}

/// The group of the first law that was accepted, or of the first that was; null where the table has none.
const AlternativeGroup* named_group(const Diagnosis& diagnosis) {
  const auto& groups = diagnosis.table.groups;
  for (const bool of_data : {false, true})
    for (const Finding& finding : accepted_of(diagnosis, of_data))
      for (const AlternativeGroup& group : groups)
        if (has(group, finding) && finding.kind != CandidateKind::numerics) return &group;
  return groups.empty() ? nullptr : &groups.front();
}

/// Those that by their probability would be; none where what was found would be as well, and runs found it all the
/// same.
std::vector<std::string> improbable_rivals(const Diagnosis& diagnosis, const AlternativeGroup& group) {
  std::vector<std::string> all;
  for (const Alternative& member : group.members)
    for (const Finding& finding : diagnosis.effects) {
      if (!(member.share < told) || !is_same(member, finding)) continue;
      if (finding.accepted) return {};
      if (finding.rival) all.push_back(name_of(finding));
    }
  return all;
}

/// "contact stiffness at spine 69 %, visco_elastic stiffness at spine 31 %, others below 2 %"; empty where it is one.
std::string shares_of(const AlternativeGroup& group) {
  std::vector<std::string> all;
  for (const Alternative& member : group.members)
    if (member.share >= told) all.push_back(fmt::format("{} {}", name_of(member), percent_of(member.share)));
  if (all.size() < 2) return "";
  return fmt::format("{}{}", fmt::join(all, ", "), all.size() < group.members.size() ? ", others below 2 %" : "");
}

/// How probable each of those is that these data cannot tell apart, of what was accepted, where runs did not choose
/// what the table has below all others.
void add_shares(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  if (diagnosis.verdict != Verdict::ambiguous) return;
  for (const AlternativeGroup& group : diagnosis.table.groups) {
    const bool is_of_the_table =
        std::any_of(group.members.begin(), group.members.end(), [&](const Alternative& member) {
          return member.share >= told &&
                 std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                             [&](const Finding& finding) { return finding.accepted && is_same(member, finding); });
        });
    if (const std::string shares = shares_of(group); is_of_the_table && !shares.empty())
      all.push_back("Of these the probability is: " + shares);
  }
}

/// Why something that is improbable is a rival. (D.21)
void add_why_open(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  if (diagnosis.verdict != Verdict::ambiguous) return;
  std::vector<std::string> open;
  for (const AlternativeGroup& group : diagnosis.table.groups)
    for (std::string& name : improbable_rivals(diagnosis, group)) open.push_back(std::move(name));
  if (open.empty()) return;
  all.push_back(
      fmt::format("If errors are as stated it is not {} (below 2 %). That rests on a fifth of the moments: the others "
                  "alone leave it open, and a few may be off by more than is stated",
                  fmt::join(open, ", nor ")));
}

/// An explanation that is more probable than nothing, and not probable enough to be named.
void add_what_is_not_ruled_out(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const auto& table = diagnosis.table;
  if (diagnosis.verdict != Verdict::nothing_missing || table.groups.empty()) return;
  const AlternativeGroup& first = table.groups.front();
  if (first.probability <= table.nothing) return;
  std::vector<std::string> members;
  for (const Alternative& member : first.members) members.push_back(name_of(member));
  all.push_back(
      fmt::format("It is not ruled out that {} is: its probability is {}, at least {} whatever is assumed, that of "
                  "nothing {}. These data cannot tell",
                  fmt::join(members, " or "), percent_of(first.probability), percent_of(first.least_probability),
                  percent_of(table.nothing)));
}

/// Where runs of several effects together named what the table, which adds up what each does by itself, does not have.
void add_what_runs_changed(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const auto& groups = diagnosis.table.groups;
  const auto is_likely = [](const AlternativeGroup& group, const Finding& finding) {
    return std::any_of(group.members.begin(), group.members.end(), [&](const Alternative& member) {
      return member.share * group.probability >= told && is_same(member, finding);
    });
  };
  std::vector<std::string> named, instead;
  for (const Finding& finding : diagnosis.effects)
    if (finding.accepted &&
        std::none_of(groups.begin(), groups.end(), [&](const auto& group) { return is_likely(group, finding); }))
      named.push_back(name_of(finding));
  for (const AlternativeGroup& group : groups)
    if (group.probability >= 0.95 &&
        std::none_of(diagnosis.effects.begin(), diagnosis.effects.end(), [&](const Finding& finding) {
          return (finding.accepted || finding.rival) && is_likely(group, finding);
        }))
      instead.push_back(name_of(group.members.front()));
  if (named.empty() || instead.empty()) return;
  all.push_back(
      fmt::format("The table adds up what each does by itself. Runs of all together ask for {}, and not for {}",
                  fmt::join(named, " and "), fmt::join(instead, ", nor for ")));
}

/// Rivals of a sure verdict are variants of what was found.
void add_variants(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  for (const Finding& finding : diagnosis.effects)
    if (finding.rival) all.push_back(fmt::format("These data cannot tell it from its variant {}", text_of(finding)));
}

/// Where on the wall what is left is largest, if that is beyond chance.
void add_place_of_what_is_left(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const auto& located = diagnosis.located.after;
  if (!located || located->p > diagnosis.alpha / 5) return;
  std::vector<std::string> regions;
  for (const PatchShare& share : located->regions) regions.push_back(share.region);
  all.push_back(
      fmt::format("What is left is largest within {:.2g} {} of ({:.3g}, {:.3g}, {:.3g}), known to {:.2g} {}, in {}: "
                  "the data lie up to {:.2g} {} {} the model there, at {:.3g} s",
                  located->radius, located->unit, located->centre[0], located->centre[1], located->centre[2],
                  located->resolution, located->unit, fmt::join(regions, ", "), std::abs(located->amount),
                  located->unit, located->amount > 0 ? "outside" : "inside", located->time));
}

/// How exactly the place of what was found is known, where that is a patch.
void add_place(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const auto is_on_it = [](const Finding& finding) { return finding.accepted && finding.patch; };
  if (!diagnosis.patch || std::none_of(diagnosis.effects.begin(), diagnosis.effects.end(), is_on_it)) return;
  const PatchPlace& place = *diagnosis.patch;
  all.push_back(fmt::format(
      "No region holds it: of {} patches that were tried this one explains most. Its centre is known to {:.2g} {}, its "
      "radius to be {:.2g} .. {:.2g} {}; its strength is that of this patch, and goes with the size",
      place.tried, place.known_to, place.unit, place.least_radius, place.largest_radius, place.unit));
}

/// What to ask where what data of the wall do not bear out may be an error of an instrument; empty where none is.
std::string instrument_hint(const Diagnosis& diagnosis) {
  if (diagnosis.faults_not_asked.empty()) return "";
  return fmt::format("if an instrument may be off all over, let diagnosis.also name {}",
                     fmt::join(diagnosis.faults_not_asked, ", "));
}

void add_held_out(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  all.push_back(held_out_sentence(*diagnosis.held_out));
  const bool names = diagnosis.verdict == Verdict::missing || diagnosis.verdict == Verdict::ambiguous;
  if (std::string hint = instrument_hint(diagnosis); names && diagnosis.held_out->value < 0 && !hint.empty())
    all.back() += "; " + hint;
}

void add_what_is_left(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const Verdict verdict = diagnosis.verdict;
  const auto& after = diagnosis.lack_of_fit.after;
  const bool names = verdict == Verdict::missing || verdict == Verdict::ambiguous;
  if (names && leaves_patterns(diagnosis) && after)
    all.push_back(fmt::format("Something smaller is left: {}", where_left(*after)));
  else if (names && diagnosis.doubtful && after && any_accepted(diagnosis))
    all.push_back(
        fmt::format("More is left than noise and the errors allowed make in one of twenty data sets; farthest "
                    "off: {}",
                    where_left(*after)));
  if (!diagnosis.strained_errors.empty() && !any_accepted(diagnosis)) all.push_back(strained_sentence(diagnosis));
  if (verdict == Verdict::undecided && diagnosis.doubtful && after)
    all.push_back(fmt::format("Farthest off: {}", where_left(*after)));
  add_place_of_what_is_left(all, diagnosis);
}

void add_noise(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  constexpr double noteworthy = 1.05;
  for (const NoiseFactor& noise : diagnosis.noise_factors)
    if (std::max(noise.factor, noise.long_waves) > noteworthy)
      all.push_back(
          fmt::format("The noise of {} is taken for {:.2f} times what is stated, {:.2f} times in long waves, "
                      "as the data have it",
                      noise.source, noise.factor, noise.long_waves));
  if (diagnosis.verdict == Verdict::not_in_catalogue) return;  // what is left is more than noise
  for (const NoiseCheck& check : diagnosis.noise)
    if (is_contradicted(check)) all.push_back(sentence_of(check));
}

void add_closest(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  if (any_accepted(diagnosis))
    all.push_back(fmt::format("Closest, but not enough: {}", fmt::join(accepted_texts(diagnosis), "; and ")));
  if (!diagnosis.path.empty() && !diagnosis.path.back().accepted) all.push_back(refusal_text(diagnosis.path.back()));
}

/// How the first of what was found foretells moments; whether nothing but the fit itself speaks for it.
void add_foretold(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const AlternativeGroup* group = named_group(diagnosis);
  if (group && group->foretold)
    all.push_back(fmt::format("Each moment foretold from the others: better with it for {} of {}",
                              group->foretold->better, group->foretold->moments));
  else if (!diagnosis.held_out)
    all.push_back("Not confirmed: no frames are held out");
}

/// What the name of what leads depends on.
void add_certainty(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const AlternativeGroup* group = named_group(diagnosis);
  constexpr double even = 0.5, no_news = 0.995;
  if (diagnosis.table.otherwise.empty() || !group || diagnosis.verdict == Verdict::not_in_catalogue) return;
  if (group->probability < even || group->least_probability > no_news) return;
  const std::string most = percent_of(group->probability), least = percent_of(group->least_probability);
  all.push_back(fmt::format(
      "Its probability is {}, {} if effects may be half or twice as large, the noise is 30 % off, or the model's own "
      "error half or twice what was assumed",
      most, most == least ? "also" : "and at least " + least));
}

/// Stiff supports that were told on a tube of 12 x 8 as a fifth of what they are, with an interval that ends at half.
void add_coarseness(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  const std::vector<Finding> errors = accepted_of(diagnosis, true);
  const auto is_of_numerics = [](const Finding& finding) { return finding.kind == CandidateKind::numerics; };
  if (std::any_of(errors.begin(), errors.end(), is_of_numerics) && !accepted_of(diagnosis, false).empty())
    all.push_back(
        "Amounts are those that fit on this mesh and step: on finer ones others may, outside these intervals too");
}

void add_rest(std::vector<std::string>& all, const Diagnosis& diagnosis) {
  add_place(all, diagnosis);
  add_coarseness(all, diagnosis);
  add_certainty(all, diagnosis);
  if (diagnosis.verdict == Verdict::missing) add_variants(all, diagnosis);
  for (std::string& sentence : look_alike_sentences(diagnosis)) all.push_back(std::move(sentence));
  if (diagnosis.dispersion > 1.5)
    all.push_back(
        fmt::format("The misfit that is left is {:.1f} times what noise makes: intervals are widened by its root, and "
                    "still optimistic",
                    diagnosis.dispersion));
  if (diagnosis.more)
    all.push_back(
        "More stands out beside it, which this diagnosis does not look for: refit it first, as tether explain does");
  if (diagnosis.verdict == Verdict::not_in_catalogue) add_closest(all, diagnosis);
  add_what_is_left(all, diagnosis);
  add_noise(all, diagnosis);
}

}  // namespace

std::vector<Finding> accepted_of(const Diagnosis& diagnosis, bool of_data) {
  std::vector<Finding> all;
  for (const Finding& finding : diagnosis.effects)
    if (finding.accepted && changes_model(finding) != of_data) all.push_back(finding);
  return all;
}

bool leaves_patterns(const Diagnosis& diagnosis) {
  const auto& after = diagnosis.lack_of_fit.after;
  return (after && after->p < diagnosis.alpha / 5) || is_no_noise(diagnosis.located.after);
}

std::string open_question_of(const Diagnosis& diagnosis) {
  if (const std::vector<Finding> laws = accepted_of(diagnosis, false); leaves_patterns(diagnosis) && !laws.empty()) {
    std::vector<std::string> names;
    for (const Finding& law : laws) names.push_back(text_of(law));
    return fmt::format(
        "{} explains most, but what that leaves is not noise: another law belongs in its place, or something beside it",
        fmt::join(names, " and "));
  }
  if (const std::vector<Finding> laws = accepted_of(diagnosis, false);
      is_refuted(diagnosis.held_out) && !laws.empty()) {
    std::vector<std::string> names;
    for (const Finding& law : laws) names.push_back(text_of(law));
    const std::string hint = instrument_hint(diagnosis);
    return fmt::format("{} explains most, but held-out frames are farther off with it{}", fmt::join(names, " and "),
                       hint.empty() ? "" : ": " + hint);
  }
  const auto& path = diagnosis.path;
  const auto open = std::find_if(path.begin(), path.end(), [](const Attempt& attempt) {
    return attempt.objection && is_of_probability(*attempt.objection);
  });
  if (open != path.end()) return refusal_text(*open);
  if (!path.empty()) return refusal_text(path.front());  // the best of them
  return diagnosis.doubtful ? "no candidate stands out, but the model is off by more than noise and the errors allowed "
                              "make by chance"
                            : "these data would not show any candidate at the size that it may have";
}

std::string headline_of(const Diagnosis& diagnosis) {
  switch (diagnosis.verdict) {
    case Verdict::missing:
    case Verdict::ambiguous:
      return sentence_of(diagnosis.verdict, diagnosis.statement, diagnosis.doubtful);
    case Verdict::nothing_missing:
      return nothing_missing_sentence(diagnosis);
    case Verdict::not_in_catalogue:
      return "NOT IN THE CATALOGUE: something is missing that no candidate explains: " + where_left(diagnosis);
    case Verdict::undecided:
      break;
  }
  return "UNDECIDED: " + open_question_of(diagnosis);
}

std::vector<std::string> look_alike_sentences(const Diagnosis& diagnosis) {
  std::vector<std::string> all;
  for (const Finding& finding : diagnosis.effects)
    if (finding.accepted)
      if (std::string alike = look_alike_sentence(diagnosis, finding); !alike.empty()) all.push_back(std::move(alike));
  return all;
}

std::vector<std::string> remarks_on(const Diagnosis& diagnosis, HeldOutGain gain) {
  std::vector<std::string> all;
  if (diagnosis.verdict == Verdict::ambiguous && diagnosis.split_by)
    all.push_back(split_sentence(*diagnosis.split_by, "tell them apart"));
  if (diagnosis.verdict == Verdict::undecided && diagnosis.split_by)
    all.push_back(split_sentence(*diagnosis.split_by, "show whether it is there"));
  add_shares(all, diagnosis);
  add_why_open(all, diagnosis);
  add_what_is_not_ruled_out(all, diagnosis);
  add_what_runs_changed(all, diagnosis);
  if (any_accepted(diagnosis)) add_foretold(all, diagnosis);
  if (diagnosis.held_out && gain == HeldOutGain::told) add_held_out(all, diagnosis);
  add_rest(all, diagnosis);
  return all;
}

std::vector<std::string> sentences_of(const Diagnosis& diagnosis) {
  std::vector<std::string> all{headline_of(diagnosis)};
  for (std::string& remark : remarks_on(diagnosis, HeldOutGain::told)) all.push_back(std::move(remark));
  return all;
}

}  // namespace tether
