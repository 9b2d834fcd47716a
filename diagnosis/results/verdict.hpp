#pragma once

#include "common/io/record.hpp"

namespace tether {

/// What the data say of a model.
enum class Verdict { missing, nothing_missing, ambiguous, not_in_catalogue, undecided };

template <>
inline constexpr auto words_of<Verdict> = std::to_array<WordOf<Verdict>>({
    {Verdict::missing, "missing", "something was found: an effect, an error of the data, or of the numerics"},
    {Verdict::nothing_missing, "nothing_missing", "what is left is within the noise and the errors allowed"},
    {Verdict::ambiguous, "ambiguous", "something is missing, and the data cannot tell which of several"},
    {Verdict::not_in_catalogue, "not_in_catalogue", "something is missing that no candidate explains"},
    {Verdict::undecided, "undecided",
     "what stands out is not confirmed, or leaves more than noise, or the data would not show it"},
});

/// Why a candidate, or a model that has it, was refused.
enum class Objection {
  too_weak,
  breaks_down,
  not_sure,
  assumed,
  not_confirmed,
  lack_of_fit_stays,
  beyond_its_limit,
  misfit_stays,
  part_of_one_law,
};

template <>
inline constexpr auto words_of<Objection> = std::to_array<WordOf<Objection>>({
    {Objection::too_weak, "too_weak", "the misfit does not fall by enough"},
    {Objection::breaks_down, "breaks_down", "the model breaks down with it"},
    {Objection::not_sure, "not_sure", "something else is not improbable enough"},
    {Objection::assumed, "assumed",
     "it is so only if the noise, or how large things may be, are just what they are taken for"},
    {Objection::not_confirmed, "not_confirmed", "held-out data do not confirm it"},
    {Objection::lack_of_fit_stays, "lack_of_fit_stays", "the lack of fit does not fall"},
    {Objection::beyond_its_limit, "beyond_its_limit", "it would have to be larger than it may be"},
    {Objection::misfit_stays, "misfit_stays", "the misfit does not fall"},
    {Objection::part_of_one_law, "part_of_one_law", "one law explains as much as it does together with another"},
});

/// What was refused may be there: something else is not improbable enough.
constexpr bool is_of_probability(Objection objection) {
  return objection == Objection::not_sure || objection == Objection::assumed;
}

/// "held-out data do not confirm it"; empty if there is none.
constexpr const char* reason_of(std::optional<Objection> objection) {
  return objection ? meaning_of(*objection) : "";
}

}  // namespace tether
