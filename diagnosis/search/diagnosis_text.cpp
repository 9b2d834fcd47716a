#include "diagnosis/search/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pictures/gnuplot.hpp"

namespace tether {
namespace {

constexpr std::size_t shown = 12;

std::string line_of(const Finding& finding) {
  const FoundAmplitude& amplitude = finding.amplitude;
  std::string line =
      fmt::format("  {:<42} {:>6.1f} {:>9.2g}  {:>9.3g} ({}) {}", name_of(finding), finding.z, finding.q,
                  amplitude.value, interval_text(amplitude), amplitude.unit == "1" ? "" : amplitude.unit);
  if (finding.held_out_gain) line += fmt::format("  held out {:+.0f} %", -100 * finding.held_out_gain->value);
  if (finding.group) line += fmt::format("  group {}", *finding.group);
  return line + (finding.accepted ? "  ACCEPTED\n" : "\n");
}

/// A line for each quantity, a column for each model; two rivals at most, the others are in diagnosis.json.
std::string published_text(const std::vector<PublishedQuantities>& models) {
  if (models.empty()) return "";
  const std::size_t count = std::min<std::size_t>(4, models.size());
  std::string text = fmt::format("\n  {:<38}", "what it changes (95 %)");
  for (std::size_t m = 0; m < count; ++m)
    text += fmt::format(" {:<26}", m == 0   ? "as it is"
                                   : m == 1 ? "with what was accepted"
                                            : fmt::format("rival {}", m - 1));
  for (std::size_t i = 0; i < models.front().quantities.size(); ++i) {
    text += fmt::format("\n  {:<38}", name_of(models.front().quantities[i]));
    for (std::size_t m = 0; m < count; ++m) text += fmt::format(" {:<26}", value_text(models[m].quantities[i]));
  }
  text += "\n";
  for (std::size_t m = 2; m < count; ++m)
    text += fmt::format("  rival {}: {}\n", m - 1, fmt::join(models[m].effects, "; "));
  return text + "\n";
}

std::string visible_text(const Diagnosis& diagnosis) {
  int seen = 0, all = 0;
  for (std::size_t i = 0; i < diagnosis.effects.size(); ++i) {
    if (diagnosis.effects[i].kind != CandidateKind::effect) continue;
    ++all;
    seen += diagnosis.detectable[i].in_scale < 1 ? 1 : 0;
  }
  return fmt::format(
      "These data would show {} of {} effects at the size that they may have in a patient (diagnosis.json: "
      "detectable)\n",
      seen, all);
}

/// What a candidate is drawn as.
int level_of(const Finding& finding, double alpha) {
  return finding.accepted ? 2 : finding.q < alpha ? 1 : 0;
}

}  // namespace

std::string text_of(const Diagnosis& diagnosis) {
  std::string text = "\n";
  for (const std::string& sentence : diagnosis.sentences) text += sentence + "\n";
  text += fmt::format("\n  {:<42} {:>6} {:>9}  {}\n", "candidate", "z", "q", "value with it (95 %)");
  const auto& effects = diagnosis.effects;
  for (std::size_t i = 0; i < std::min(shown, effects.size()); ++i) text += line_of(effects[i]);
  if (effects.size() > shown) text += fmt::format("  and {} more in diagnosis.json\n", effects.size() - shown);
  return text + published_text(diagnosis.published) + visible_text(diagnosis);
}

std::vector<std::string> draw_ranking(const Diagnosis& diagnosis, const std::filesystem::path& output) {
  if (!has_gnuplot()) return {};
  std::string rows = "$rows << END\n";
  const std::size_t count = std::min<std::size_t>(25, diagnosis.effects.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Finding& finding = diagnosis.effects[i];
    rows += fmt::format("{} {} {} {}\n", count - i, std::max(0.0, finding.misfit_removed) + 0.1,
                        gnuplot_cell(name_of(finding)), level_of(finding, diagnosis.alpha));
  }
  const std::string script =
      gnuplot_head(1000, 120 + 24 * static_cast<int>(count)) + rows + "END\n" +
      fmt::format(
          "set output 'plots/diagnosis.png'\nset title {}\nset xlabel 'misfit that the effect removes (chi-square)'\n"
          "set logscale x\nset xrange [0.1:*]\nset yrange [0:{}]\nset style fill solid 0.7\nset key bottom right\n"
          "plot for [k=0:2] $rows using (0.1):1:(0.1):($4==k?$2:0.1):($1-0.35):($1+0.35):ytic(3) with boxxyerror "
          "linecolor "
          "word('8 1 7',k+1)+0 title word('chance significant accepted',k+1)\n",
          gnuplot_text(diagnosis.case_name), count + 1);
  run_gnuplot(output, "diagnosis.gp", script);
  return {"diagnosis.png"};
}

}  // namespace tether
