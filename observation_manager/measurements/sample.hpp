#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Why a place of the model has no observation.
enum class Exclusion { none, rim, too_far, masked, near_end, flawed, no_frame, missed, held_out };
inline constexpr std::size_t exclusion_count = 9;
/// "beside the rim", ... for reports.
std::string_view meaning_of(Exclusion exclusion);

/// One measured distance at one place of the model's lumen: a node, or a point where a slice cuts a triangle.
struct Sample {
  Triangle nodes{};            ///< of the lumen that carry the place
  Vec3 shares{1, 0, 0};        ///< of these nodes, H in (O.4); sum 1
  Vec3 position{0, 0, 0};      ///< [length]
  double distance = 0;         ///< to the data, positive where they lie outside the model (O.1) [length]
  Vec3 normal{0, 0, 0};        ///< out of the lumen; in the slice's plane for a contour
  double weight = 0;           ///< area [length^2] or length [length] that the sample stands for; 0 if excluded
  int source = 0, series = 0;  ///< number of the source, and of the contour within it
  int region = -1;             ///< of the lumen's regions
  Exclusion excluded = Exclusion::none;
};

/// How many samples are excluded, by reason.
std::array<int, exclusion_count> count_exclusions(const std::vector<Sample>& samples);

/// sum over samples of weight distance^2 (O.4) [length^4 of surfaces, length^3 of contours].
double misfit(const std::vector<Sample>& samples);

}  // namespace tether
