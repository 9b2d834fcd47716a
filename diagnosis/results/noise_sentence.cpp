#include <fmt/format.h>

#include "diagnosis/results/noise.hpp"

namespace tether {
namespace {

std::string times_text(const MeasuredNumber& ratio) {
  return fmt::format("{:.2g} times as large ({:.2g} .. {:.2g})", ratio.value, ratio.lower, ratio.upper);
}

std::string time_text(const MeasuredNumber& time) {
  if (time.value <= 0) return fmt::format("no longer than {:.2g} s", time.upper);
  return fmt::format("{:.2g} s ({:.2g} .. {:.2g})", time.value, time.lower, time.upper);
}

}  // namespace

bool is_contradicted(const NoiseCheck& check) {
  return check.contradicts || check.time_contradicts;
}

std::string sentence_of(const NoiseCheck& check) {
  std::string what;
  if (check.contradicts)
    what = fmt::format("its deviation is {}, its correlation length {}", times_text(check.deviation_ratio),
                       times_text(check.length_ratio));
  if (check.time_contradicts)
    what += fmt::format("{}errors last {}, stated is {:g} s", what.empty() ? "" : ", ", time_text(*check.measured_time),
                        check.correlation_time);
  return fmt::format("The noise that is stated of {} contradicts the data: {}; tether measure-noise tells more",
                     check.source, what);
}

}  // namespace tether
