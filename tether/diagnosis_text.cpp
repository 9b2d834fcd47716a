#include "tether/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tether/gnuplot.hpp"

namespace tether {
namespace {

constexpr std::size_t shown = 12;

std::string line_of(const EffectProblem& problem, const TestedEffect& effect) {
  const Candidate& candidate = problem.candidates[effect.candidate];
  const Eigen::Index own = main_amplitude(problem, effect);
  const auto number = static_cast<std::size_t>(candidate.amplitudes[static_cast<std::size_t>(own)]);
  const Amplitude& amplitude = problem.amplitudes[number];
  const FoundValue found = value_of(problem, effect, own);
  std::string line =
      fmt::format("  {:<42} {:>6.1f} {:>9.2g}  {:>9.3g} ({}) {}", name_of(candidate), effect.z, effect.q, found.value,
                  interval_text(effect, found), amplitude.unit == "1" ? "" : amplitude.unit);
  if (effect.held_out) line += fmt::format("  held out {:+.0f} %", -100 * effect.held_out->value);
  if (effect.group >= 0) line += fmt::format("  group {}", effect.group + 1);
  return line + (effect.accepted ? "  ACCEPTED\n" : "\n");
}

std::string visible_text(const EffectProblem& problem, const SearchResult& found) {
  std::string text;
  int seen = 0, all = 0;
  for (const TestedEffect& effect : found.effects) {
    const Candidate& candidate = problem.candidates[effect.candidate];
    if (candidate.kind != Candidate::Kind::effect) continue;
    ++all;
    seen += effect.visible < problem.amplitudes[static_cast<std::size_t>(candidate.amplitudes.front())].scale ? 1 : 0;
  }
  return fmt::format(
      "These data would show {} of {} effects at the size that they may have in a patient (diagnosis.json: "
      "detectable)\n",
      seen, all);
}

}  // namespace

std::string text_of(const DiagnosisReport& report) {
  std::string text = "\n";
  for (const std::string& sentence : sentences_of(report)) text += sentence + "\n";
  text += fmt::format("\n  {:<42} {:>6} {:>9}  {}\n", "candidate", "z", "q", "value with it (95 %)");
  const auto& effects = report.found.effects;
  for (std::size_t i = 0; i < std::min(shown, effects.size()); ++i) text += line_of(report.problem, effects[i]);
  if (effects.size() > shown) text += fmt::format("  and {} more in diagnosis.json\n", effects.size() - shown);
  return text + visible_text(report.problem, report.found);
}

std::vector<std::string> draw_ranking(const DiagnosisReport& report, const std::filesystem::path& output) {
  if (!has_gnuplot()) return {};
  std::string rows = "$rows << END\n";
  const auto& effects = report.found.effects;
  const std::size_t count = std::min<std::size_t>(25, effects.size());
  for (std::size_t i = 0; i < count; ++i) {
    const TestedEffect& effect = effects[i];
    rows += fmt::format("{} {} \"{}\" {}\n", count - i,
                        std::max(0.0, effect.confirmed ? effect.confirmed_gain : effect.gain) + 0.1,
                        name_of(report.problem.candidates[effect.candidate]),
                        effect.accepted           ? 2
                        : effect.q < report.alpha ? 1
                                                  : 0);
  }
  const std::string script =
      gnuplot_head(1000, 120 + 24 * static_cast<int>(count)) + rows + "END\n" +
      fmt::format(
          "set output 'plots/diagnosis.png'\nset title '{}'\nset xlabel 'misfit that the effect removes (chi-square)'\n"
          "set logscale x\nset xrange [0.1:*]\nset yrange [0:{}]\nset style fill solid 0.7\nset key bottom right\n"
          "plot for [k=0:2] $rows using (0.1):1:(0.1):($4==k?$2:0.1):($1-0.35):($1+0.35):ytic(3) with boxxyerror "
          "linecolor "
          "word('8 1 7',k+1)+0 title word('chance significant accepted',k+1)\n",
          report.case_name, count + 1);
  run_gnuplot(output, "diagnosis.gp", script);
  return {"diagnosis.png"};
}

}  // namespace tether
