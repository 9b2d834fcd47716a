/// How often what a diagnosis says with a probability is so. After tether diagnose CASE.yaml --output DIR:
///
///     diagnosis_calibration CASE.yaml DIR DRAWS [FAMILY [FIRST]]
///
/// Draws are numbered from FIRST (0); each is what its number says, whatever was drawn before.
///
/// What is hidden is drawn from what the diagnosis expects beforehand: how many candidates, which, how large; so are
/// all errors. Families beside "as assumed" draw data in another way than the diagnosis takes them for. Prints a line
/// for everything that was said: family, draw, kind, what was said, what is so.
///
///     group     probability of a group           one of it is hidden (1 or 0)
///     member    share of a named group's first   it is the hidden one
///     nothing   probability of nothing           nothing is hidden
///     verdict   the word                         as benchmarks/diagnosis/run judges
///     interval  error over the half interval      the hidden value is inside; `interval of`: which, and its numbers
///     z         of a candidate, nothing hidden   0
///     power     size over what is detectable     its group is named
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "diagnosis/search/diagnosis_report.hpp"
#include "surrogate.hpp"
#include "twin/random.hpp"

using namespace tether;
using Index = Eigen::Index;

namespace {

struct Family {
  std::string name;
  DrawnOtherwise how;
  double discrepancy = 1;  ///< over what is drawn beforehand
};

const std::vector<Family> families{{"as assumed", {}},
                                   {"errors alike over half the length", {.length = 0.5}},
                                   {"errors alike over twice the length", {.length = 2}},
                                   {"errors of a Gaussian correlation", {.gaussian = true}},
                                   {"errors 1.3 times as large", {.deviation = 1.3}},
                                   {"the model off alike in all frames", {.lasting = true}},
                                   {"effects that saturate where they do most", {.flattens = true}}};

/// What is drawn, and what is known of it.
struct Draw {
  std::vector<std::size_t> hidden;
  VectorXd amplitudes;
  double discrepancy = 1;
};

double laplace(Random& random, double deviation) {
  const double u = random.uniform() - 0.5;
  return -deviation / std::sqrt(2) * std::copysign(std::log(1 - 2 * std::abs(u)), u);
}

/// As a diagnosis expects it beforehand (D.19).
double drawn_size(const Amplitude& amplitude, Random& random) {
  const double scale = amplitude.scale > 0 && std::isfinite(amplitude.scale) ? amplitude.scale : 1;
  while (true) {
    const double any = amplitude.doubles ? laplace(random, scale) : scale * std::tan(M_PI * (random.uniform() - 0.5)),
                 size = amplitude.one_sided ? std::abs(any) : any;
    if (amplitude.limited(size) == size) return size;
  }
}

/// Two that do much the same at once are none of the sets that a diagnosis weighs.
Draw drawn(const Surrogate& surrogate, const SetEvidence& evidence, const std::vector<double>& odds,
           std::uint64_t seed) {
  Random random(seed, 7);
  constexpr std::size_t most = 3;
  constexpr std::array small{0.1, 0.2, 0.4, 0.7, 1.0};
  Draw draw{
      {}, VectorXd::Zero(surrogate.problem.changes.cols()), small.at(static_cast<std::size_t>(5 * random.uniform()))};
  for (std::size_t c = 0; c < odds.size(); ++c) {
    const bool is_drawn = random.uniform() < odds[c] / (1 + odds[c]);
    const bool is_there = is_drawn && draw.hidden.size() < most &&
                          std::none_of(draw.hidden.begin(), draw.hidden.end(),
                                       [&](std::size_t other) { return std::pow(evidence.cosine(c, other), 2) > 0.5; });
    const auto& own = surrogate.problem.candidates[c].amplitudes;
    constexpr std::array multiples{0.3, 1.0, 3.0, 10.0};
    const double multiple = multiples.at(static_cast<std::size_t>(4 * random.uniform()));
    for (const Index i : own) {
      const Amplitude& amplitude = surrogate.problem.amplitudes[static_cast<std::size_t>(i)];
      const double size =
          own.size() == 1 ? drawn_size(amplitude, random) : multiple * amplitude.scale * random.normal();
      if (is_there) draw.amplitudes(i) = size;
    }
    if (is_there) draw.hidden.push_back(c);
  }
  return draw;
}

bool is_hidden(const Draw& draw, std::size_t candidate) {
  return std::find(draw.hidden.begin(), draw.hidden.end(), candidate) != draw.hidden.end();
}

class Calibration {
 public:
  Calibration(const Surrogate& surrogate, const Family& family)
      : surrogate_(surrogate),
        family_(family),
        evidence_(surrogate.problem, {}),
        odds_(posterior_of(surrogate.problem, evidence_, std::vector<bool>(surrogate.problem.candidates.size(), false))
                  .prior) {}

  void run(int number) {
    number_ = number;
    const auto seed = static_cast<std::uint64_t>(number) + 1;
    const Draw draw = drawn(surrogate_, evidence_, odds_, seed);
    const VectorXd errors = surrogate_.errors(seed, family_.discrepancy * draw.discrepancy, family_.how);
    tell(draw, surrogate_.search(errors + surrogate_.effect_of(draw.amplitudes, family_.how), {}, family_.how));
    if (draw.hidden.empty()) tell_scores(errors);
    tell_power(errors);
  }

 private:
  void print(const char* kind, const std::string& said, const std::string& is_so) const {
    std::cout << fmt::format("{},{},{},{},{}\n", family_.name, number_, kind, said, is_so);
  }
  void print(const char* kind, double said, double is_so) const {
    print(kind, fmt::format("{:.4f}", said), fmt::format("{:g}", is_so));
  }

  void tell(const Draw& draw, const SearchResult& result) const {
    constexpr double told = 0.02, named = 0.95;
    const auto hidden = [&](std::size_t c) { return is_hidden(draw, c); };
    for (const WeighedGroup& group : result.weighed.groups) {
      if (group.probability < told) continue;
      const bool right = std::any_of(group.members.begin(), group.members.end(), hidden);
      print("group", group.probability, right);
      if (right && group.probability > named) print("member", group.shares.front(), hidden(group.members.front()));
    }
    print("nothing", result.weighed.nothing, draw.hidden.empty());
    print("verdict", word_of(result.verdict), judgement(result, draw.hidden, Verdict::nothing_missing));
    for (const TestedEffect& effect : result.effects)
      if (effect.accepted && hidden(effect.candidate)) tell_interval(draw, effect);
    std::cout << std::flush;
  }
  void tell_interval(const Draw& draw, const TestedEffect& effect) const {
    const Index own = surrogate_.problem.candidates[effect.candidate].amplitudes[0];
    const FoundValue found = value_of(surrogate_.problem, effect, 0);
    const double value = surrogate_.problem.amplitudes[static_cast<std::size_t>(own)].value(draw.amplitudes(own));
    const auto [least, most] = std::minmax(found.lower, found.upper);
    const double half = value > found.value ? most - found.value : found.value - least;
    print("interval", (value - found.value) / half, least <= value && value <= most);
    std::string others;
    for (const std::size_t c : draw.hidden)
      if (c != effect.candidate) others += " beside " + name_of(surrogate_.problem.candidates[c]);
    print("interval of", name_of(surrogate_.problem.candidates[effect.candidate]) + others,
          fmt::format("{:.4g}: {:.4g} ({:.4g} .. {:.4g})", value, found.value, least, most));
  }
  /// With the model as far off as it may be.
  void tell_scores(const VectorXd& errors) const {
    const Trained trained(surrogate_.problem);
    const Scores scores = trained.scores(surrogate_.problem.changes, errors);
    for (Index k = 0; k < scores.response.size(); ++k)
      print("z", scores.response(k) / std::sqrt(scores.information(k, k)), 0);
  }
  /// One effect that can be shown, in turn, beside these errors.
  void tell_power(const VectorXd& errors) const {
    constexpr std::array times{0.5, 0.75, 1.0, 1.5, 2.0};
    if (surrogate_.shown.empty()) return;
    const auto turn = static_cast<std::size_t>(number_);
    const std::size_t c = surrogate_.shown[turn / times.size() % surrogate_.shown.size()];
    const double size = times.at(turn % times.size());
    const VectorXd made = surrogate_.effect_of(surrogate_.amplitudes({{c, size}}), family_.how);
    const SearchResult result = surrogate_.search(errors + made, {}, family_.how);
    const std::string judged = judgement(result, {c}, Verdict::missing);
    print("power judged", fmt::format("{} at {}", name_of(surrogate_.problem.candidates[c]), size), judged);
    std::string objections;
    for (const SearchStep& step : result.path)
      objections +=
          fmt::format("{}{}", objections.empty() ? "" : " ", step.objection ? word_of(*step.objection) : "none");
    print("power objections", fmt::format("{} at {:.2f}", size, result.weighed.nothing), objections);
    print("power", size, judged == "right" || judged == "alike");
    std::cout << std::flush;
  }

  const Surrogate& surrogate_;
  const Family& family_;
  SetEvidence evidence_;
  std::vector<double> odds_;
  int number_ = 0;
};

}  // namespace

int main(int count, char** words) {
  if (count < 4) {
    std::cerr << "diagnosis_calibration CASE.yaml DIR DRAWS [FAMILY [FIRST]]\n";
    return 2;
  }
  const Surrogate surrogate(words[1], words[2]);
  for (const Family& family : families) {
    if (count > 4 && family.name.find(words[4]) == std::string::npos) continue;
    Calibration calibration(surrogate, family);
    const int first = count > 5 ? std::atoi(words[5]) : 0;
    for (int number = first; number < first + std::atoi(words[3]); ++number) calibration.run(number);
  }
  return 0;
}
