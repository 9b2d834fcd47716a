#include "diagnosis/results/finding.hpp"

#include <fmt/format.h>

namespace tether {
namespace {

std::string unit_text(const FoundAmplitude& amplitude) {
  return amplitude.unit == "1" ? "" : " " + amplitude.unit;
}

/// "factor" of "solid.effects.contact.factor".
std::string short_name(const FoundAmplitude& amplitude) {
  return amplitude.parameter.substr(amplitude.parameter.rfind('.') + 1);
}

}  // namespace

std::string name_of(const Finding& finding) {
  const std::string name = finding.parameter ? finding.name + " " + *finding.parameter : finding.name;
  return finding.where.empty() ? name : name + " at " + finding.where;
}

std::string interval_text(const FoundAmplitude& a) {
  constexpr double anything = 1e4;  // between its ends
  if (a.lower > 0 && a.upper > anything * a.lower) return "hardly known";
  return a.at_limit ? "its limit" : fmt::format("{:.3g} .. {:.3g}", a.lower, a.upper);
}

std::string text_of(const Finding& finding) {
  const FoundAmplitude& a = finding.amplitude;
  return fmt::format("{}, {} {:.3g}{} ({})", name_of(finding), short_name(a), a.value, unit_text(a), interval_text(a));
}

std::string rough_text_of(const Finding& finding) {
  const FoundAmplitude& a = finding.amplitude;
  return fmt::format("{}, {} about {:.2g}{}{}", name_of(finding), short_name(a), a.value, unit_text(a),
                     a.at_limit ? " (its limit)" : "");
}

}  // namespace tether
