#include <fmt/format.h>

#include "diagnosis/results/noise.hpp"

namespace tether {
namespace {

std::string times_text(const MeasuredNumber& ratio) {
  return fmt::format("{:.2g} times as large ({:.2g} .. {:.2g})", ratio.value, ratio.lower, ratio.upper);
}

}  // namespace

std::string sentence_of(const NoiseCheck& check) {
  return fmt::format(
      "The noise that is stated of {} contradicts the data: its deviation is {}, its correlation length {}; "
      "tether measure-noise tells more",
      check.source, times_text(check.deviation_ratio), times_text(check.length_ratio));
}

}  // namespace tether
