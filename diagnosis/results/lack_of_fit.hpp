#pragma once

#include <optional>
#include <string>

#include "common/io/record.hpp"

namespace tether {

/// Along the vessel: all of a region alike, its inlet end against its outlet end, both ends against the middle.
enum class PatternForm { alike, end_to_end, ends };

template <>
inline constexpr auto words_of<PatternForm> = std::to_array<WordOf<PatternForm>>({
    {PatternForm::alike, "alike", "all of the region alike"},
    {PatternForm::end_to_end, "end_to_end", "its inlet end against its outlet end"},
    {PatternForm::ends, "ends", "both its ends against the middle"},
});

/// How much of a misfit no noise, no allowed error and no accepted effect explains, and its worst pattern.
struct LackOfFitFound {
  static constexpr const char* type_name = "lack_of_fit";
  double p = 1, excess = 0, beyond_noise = 0;
  std::string worst_region;
  PatternForm worst_form = PatternForm::alike;
  std::optional<double> worst_time;
  double worst_z = 0;

  static void fields(auto& self, auto&& field) {
    field("p", self.p, "probability that noise alone makes the worst pattern");
    field("excess", self.excess, "of the patterns' squares over what noise makes");
    field("beyond_noise", self.beyond_noise, "of them over what noise makes in one of twenty cases");
    field("worst_region", self.worst_region, "of the wall");
    field("worst_form", self.worst_form, "along the vessel");
    field("worst_time", self.worst_time, "[s]; null: over the beat");
    field("worst_z", self.worst_z, "its significance; negative: the model lies too far outward");
  }
};

struct LackOfFitChange {
  static constexpr const char* type_name = "lack_of_fit_change";
  std::optional<LackOfFitFound> before, after;

  static void fields(auto& self, auto&& field) {
    field("before", self.before, "of the model as it is");
    field("after", self.after, "with what was accepted");
  }
};

}  // namespace tether
