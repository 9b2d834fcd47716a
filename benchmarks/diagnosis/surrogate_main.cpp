/// The search for a missing effect on the real sensitivities of a case, with drawn data instead of runs: how often it
/// is right. After tether diagnose CASE.yaml --output DIR:
///
///     diagnosis_surrogate CASE.yaml DIR [TRIALS] [ONE SCENARIO]
///
/// Data are errors of the stated deviations and correlations, in space and in time, errors of inputs, bias and place as
/// allowed, and what is hidden; effects saturate at ten times what the data just show. Where nothing
/// is hidden there are a hundred trials at least.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>

#include "diagnosis/search/diagnosis_report.hpp"
#include "surrogate.hpp"

using namespace tether;
using Index = Eigen::Index;

namespace {

/// Counts of a scenario's trials, by words.
struct Tally {
  std::map<std::string, int> count;
  int inside = 0, amplitudes = 0;
  double rms = 0;
};

void print_head() {
  std::cout << "| hidden | times | right | alike | careful | missed | in part | wrong | inside 95 % | verdicts |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
}

void print(const std::string& name, const std::string& times, Tally& tally, int trials) {
  std::string verdicts;
  for (const auto& [word, n] : tally.count)
    if (word.starts_with("=")) verdicts += fmt::format("{}{} {}", verdicts.empty() ? "" : ", ", word.substr(1), n);
  const auto share = [&](const char* word) { return fmt::format("{:.0f} %", 100.0 * tally.count[word] / trials); };
  std::cout << fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, times, share("right"),
                           share("alike"), share("careful"), share("missed"), share("in part"), share("wrong"),
                           tally.amplitudes > 0 ? fmt::format("{:.0f} %", 100.0 * tally.inside / tally.amplitudes) : "",
                           verdicts)
            << std::flush;
}

/// Whether all that is named does to these data nearly what the candidates that were taken away do.
bool looks_like(const Surrogate& surrogate, const SearchResult& result, const std::vector<std::size_t>& without) {
  const Scores scores = Trained(surrogate.problem).scores(surrogate.problem.changes, surrogate.problem.residual);
  const auto alone = [&](std::size_t candidate) {
    TestedEffect effect;
    effect.candidate = candidate;
    effect.amplitudes =
        VectorXd::Unit(static_cast<Index>(surrogate.problem.candidates[candidate].amplitudes.size()), 0);
    return effect;
  };
  for (const TestedEffect& effect : result.effects)
    if (effect.accepted && std::none_of(without.begin(), without.end(), [&](std::size_t one) {
          return std::abs(cosine(surrogate.problem, scores, alone(one), effect)) > 0.9;
        }))
      return false;
  return true;
}

/// Trials of one scenario: what is hidden beside what the catalogue has, and which candidates are taken away.
struct Scenario {
  std::string name, times;
  std::vector<std::pair<std::size_t, double>> hidden;
  VectorXd beside;
  std::vector<std::size_t> without;
  Verdict verdict = Verdict::missing;
};

void run(const Surrogate& surrogate, const Scenario& scenario, int trials) {
  Tally tally;
  const VectorXd amplitudes = surrogate.amplitudes(scenario.hidden);
  std::vector<std::size_t> hidden;
  for (const auto& [candidate, times] : scenario.hidden) hidden.push_back(candidate);
  const bool is_control = !scenario.without.empty();
  for (int trial = 0; trial < trials; ++trial) {
    VectorXd residual = surrogate.errors(static_cast<std::uint64_t>(trial) + 1) + surrogate.effect_of(amplitudes);
    if (scenario.beside.size() > 0) residual += scenario.beside;
    const SearchResult result = surrogate.search(residual, scenario.without);
    std::string judged = judgement(result, is_control ? std::vector<std::size_t>{} : hidden, scenario.verdict);
    if (is_control && judged == "wrong" && looks_like(surrogate, result, scenario.without)) judged = "alike";
    ++tally.count[judged];
    ++tally.count[std::string("=") + word_of(result.verdict)];
    for (const TestedEffect& effect : result.effects)
      if (effect.accepted && !is_control)
        for (const auto& [candidate, times] : scenario.hidden)
          if (candidate == effect.candidate) {
            const double true_one = times * surrogate.visible[candidate];
            const FoundValue found = value_of(surrogate.problem, effect, 0);
            const double value =
                surrogate.problem
                    .amplitudes[static_cast<std::size_t>(surrogate.problem.candidates[candidate].amplitudes[0])]
                    .value(true_one);
            ++tally.amplitudes;
            tally.inside += std::min(found.lower, found.upper) <= value && value <= std::max(found.lower, found.upper);
          }
  }
  print(scenario.name, scenario.times, tally, trials);
}

/// A bulge of the data that no candidate makes: around half the vessel's height, twice a beat.
VectorXd stranger(const Surrogate& surrogate, double size) {
  VectorXd all = VectorXd::Zero(surrogate.as_measured.residual.size());
  const auto& places = surrogate.evidence.places();
  const double low = places.row(2).minCoeff(), high = places.row(2).maxCoeff();
  for (const auto& part : surrogate.evidence.parts())
    for (Index i = part.first; !part.is_record && i < part.first + part.count; ++i) {
      const double z = (places(2, i) - low) / (high - low);
      const Vec3 n = surrogate.evidence.normals().col(i);
      all(i) = size * std::sin(15.2 * part.time) * std::exp(-30 * std::pow(z - 0.5, 2)) * std::max(0.0, n(1));
    }
  return surrogate.whitening(all);
}

std::vector<Scenario> scenarios(const Surrogate& s) {
  std::vector<Scenario> all{{"nothing", "", {}, {}, {}, Verdict::nothing_missing}};
  for (const std::size_t c : s.shown)
    for (const double times : {1.0, 2.0, 4.0})
      all.push_back({name_of(s.problem.candidates[c]), fmt::format("{}", times), {{c, times}}, {}, {}});
  for (std::size_t k = 0; k + 1 < s.shown.size(); k += 2)
    all.push_back({fmt::format("{} and {}", name_of(s.problem.candidates[s.shown[k]]),
                               name_of(s.problem.candidates[s.shown[s.shown.size() - 1 - k]])),
                   "4",
                   {{s.shown[k], 4}, {s.shown[s.shown.size() - 1 - k], 4}},
                   {},
                   {}});
  const double sigma = s.evidence.noise(s.evidence.parts().front()).deviation;
  for (const double size : {2.0, 4.0, 8.0})
    all.push_back({"a bulge that nothing makes",
                   fmt::format("{} noises", size),
                   {},
                   stranger(s, size * sigma),
                   {},
                   Verdict::not_in_catalogue});
  std::map<std::string, int> frames;
  for (std::size_t c = 0; c < s.problem.candidates.size(); ++c)  // of single frames the third
    if (const Candidate& candidate = s.problem.candidates[c];
        candidate.kind == Candidate::Kind::data && (candidate.confirmable || ++frames[candidate.name] == 3))
      for (const double times : {2.0, 4.0})
        all.push_back({name_of(candidate), fmt::format("{}", times), {{c, times}}, {}, {}});
  for (const std::size_t c : s.shown)
    all.push_back({"without " + name_of(s.problem.candidates[c]), "4", {{c, 4}}, {}, {c}, Verdict::not_in_catalogue});
  return all;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::cerr << "diagnosis_surrogate CASE.yaml DIR [TRIALS] [ONE SCENARIO]\n";
    return 2;
  }
  const Surrogate surrogate(words[1], words[2]);
  const int trials = count > 3 ? std::atoi(words[3]) : 100;
  std::cout << fmt::format("{} data ({:.0f} independent), {} candidates, of which {} effects can be shown\n\n",
                           surrogate.problem.training.size(),
                           surrogate.problem.independent(surrogate.problem.training).sum(),
                           surrogate.problem.candidates.size(), surrogate.shown.size());
  print_head();
  constexpr int for_false_alarms = 100;  // at least
  for (const Scenario& scenario : scenarios(surrogate))
    if (count < 5 || scenario.name.find(words[4]) != std::string::npos)
      run(surrogate, scenario, scenario.name == "nothing" ? std::max(trials, for_false_alarms) : trials);
  return 0;
}
