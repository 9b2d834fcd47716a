#include "diagnosis/search/patch_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "diagnosis/search/spread_points.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double still_possible = 3.5;  ///< logarithm of evidence, as where runs are wanted (wanted_runs.cpp)
constexpr double much = 0.5;            ///< probability of a group; share of a patch
constexpr std::size_t most_told = 30;   ///< patches
constexpr Index around = 6;
constexpr double wider = std::numbers::sqrt2;  ///< of sizes that are compared: half or twice the area

/// What acts on regions, each type once: of the catalogue, and what only the model has.
std::vector<PlacedEffect> laws_on_regions(const std::vector<PlacedEffect>& effects) {
  std::set<std::string> divided, known;
  for (const PlacedEffect& effect : effects)  // rings and the surroundings as such have no parts
    if (!effect.extent.is_all()) divided.insert(effect.part);
  divided.erase("");
  std::vector<PlacedEffect> laws;
  for (const bool is_new : {true, false})
    for (const PlacedEffect& effect : effects)
      if (effect.is_new == is_new && divided.contains(effect.part) && known.insert(effect.type).second)
        laws.push_back({"", effect.type, "", is_new ? effect.meaning : "As the model has it elsewhere", true,
                        effect.required, effect.variant_of});
  return laws;
}

bool is_one_of(const std::vector<PlacedEffect>& laws, const Candidate& candidate) {
  const auto is_it = [&](const PlacedEffect& law) { return law.type == candidate.type; };
  return !candidate.part.empty() && candidate.amplitudes.size() == 1 && std::any_of(laws.begin(), laws.end(), is_it);
}

/// Of a candidate, beside those of what leads with which it explains most.
double evidence_of(std::size_t candidate, const std::vector<std::size_t>& leading, const SetEvidence& evidence) {
  double most = -infinite;
  for (std::size_t subset = 0; subset < std::size_t{1} << leading.size(); ++subset) {
    std::vector<std::size_t> members{candidate};
    for (std::size_t k = 0; k < leading.size(); ++k)
      if ((subset >> k & 1) != 0 && std::pow(evidence.cosine(candidate, leading[k]), 2) < look_alike)
        members.push_back(leading[k]);
    most = std::max(most, evidence.fit(members, 0).log_evidence);
  }
  return most;
}

/// The region that holds most of a ball's nodes; empty if none does.
std::string region_of_most(const Ball& ball, const LumenSurface& lumen, const VectorXd& areas) {
  std::map<int, double> shares;
  double sum = 0;
  for (Index i = 0; i < lumen.points.cols(); ++i) {
    if ((lumen.points.col(i) - ball.centre).norm() > ball.radius) continue;
    shares[lumen.region[static_cast<std::size_t>(i)]] += areas[i];
    sum += areas[i];
  }
  for (const auto& [region, share] : shares)
    if (region >= 0 && share > much * sum) return lumen.region_names[static_cast<std::size_t>(region)];
  return {};
}

}  // namespace

Leading leading_in(const Weighed& weighed) {
  constexpr std::size_t most = 2;  // a patch is the third
  Leading all;
  for (const WeighedGroup& group : weighed.groups) {
    if (group.probability <= much || all.candidates.size() == most) continue;
    all.candidates.push_back(group.members.front());
    all.amplitudes.push_back(group.amplitudes.front());
  }
  return all;
}

PatchSearch::PatchSearch(const std::vector<PlacedEffect>& effects, const LumenSurface& lumen, std::string length)
    : laws_(laws_on_regions(effects)), lumen_(lumen), length_(std::move(length)), areas_(nodal_areas(lumen)) {
  for (const PlacedEffect& effect : effects) paths_.insert(effect.path);
}

std::vector<PatchEffect> PatchSearch::next(const EffectProblem& problem, const Weighing& weighing,
                                           const std::vector<Ball>& starts) {
  if (stage_ == Stage::done) return {};
  const SetEvidence evidence(problem, weighing.shown);
  if (stage_ == Stage::not_begun) {
    choose_law(problem, evidence);
    leading_ = leading_in(weighing.weighed).candidates;
    stage_ = Stage::moving;
    return law_.empty() ? std::vector<PatchEffect>{} : first_patches(starts);
  }
  const std::vector<Tried> all = tried(problem, evidence);
  const auto is_better = [](const Tried& a, const Tried& b) { return a.evidence < b.evidence; };
  const auto best = std::max_element(all.begin(), all.end(), is_better);
  if (best == all.end() || best->evidence < evidence.fit(leading_, 0).log_evidence - still_possible) {
    stage_ = Stage::done;
    return {};
  }
  best_ = best->ball;
  for (; step_ > best_.radius / 4 && told_.size() < most_told; step_ /= 2)
    if (std::vector<PatchEffect> wanted = neighbours(); !wanted.empty()) return wanted;
  stage_ = Stage::done;
  set_place(all);
  return other_laws();
}

std::vector<PatchEffect> PatchSearch::first_patches(const std::vector<Ball>& starts) {
  std::vector<PatchEffect> wanted;
  for (const Ball& start : starts) {
    best_ = start;
    step_ = std::max(step_, start.radius);
    if (!is_known(start)) wanted.push_back(told(law_, start, number_));
    for (PatchEffect& beside : neighbours()) wanted.push_back(std::move(beside));
  }
  return wanted;
}

void PatchSearch::choose_law(const EffectProblem& problem, const SetEvidence& evidence) {
  double most = -infinite;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    const Candidate& candidate = problem.candidates[c];
    if (!is_one_of(laws_, candidate)) continue;
    const double gain = evidence.fit({c}, 0).log_evidence;
    if (gain <= most) continue;
    most = gain;
    law_ = candidate.type;
    number_ = candidate.number;
  }
}

std::vector<PatchSearch::Tried> PatchSearch::tried(const EffectProblem& problem, const SetEvidence& evidence) const {
  std::vector<Tried> all;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    const Candidate& candidate = problem.candidates[c];
    if (candidate.is_tried && candidate.type == law_ && candidate.number == number_)
      all.push_back({*candidate.extent.about, evidence_of(c, leading_, evidence)});
  }
  return all;
}

void PatchSearch::set_place(const std::vector<Tried>& all) {
  constexpr double within = 5.99 / 2;  // of the logarithm: chi-square, two numbers
  place_ = PatchPlace{best_, infinite, best_.radius, best_.radius, static_cast<int>(all.size()), length_};
  double most = -infinite;
  for (const Tried& one : all) most = std::max(most, one.evidence);
  const auto away = [&](const Tried& one) { return (one.ball.centre - best_.centre).norm(); };
  for (const Tried& one : all)
    if (away(one) > 0) place_->known_to = std::min(place_->known_to, away(one));
  if (!std::isfinite(place_->known_to)) place_->known_to = best_.radius;  // no run of another place came to its end
  for (const Tried& one : all) {
    if (one.evidence < most - within) continue;
    place_->known_to = std::max(place_->known_to, away(one));
    place_->least_radius = std::min(place_->least_radius, one.ball.radius);
    place_->largest_radius = std::max(place_->largest_radius, one.ball.radius);
  }
}

std::vector<PatchEffect> PatchSearch::neighbours() {
  constexpr double nearer = 0.7, farther = 1.3;  // of a step
  const VectorXd away = (lumen_.points.colwise() - best_.centre).colwise().norm();
  std::vector<Index> at_a_step;
  for (Index i = 0; i < away.size(); ++i)
    if (away[i] > nearer * step_ && away[i] < farther * step_) at_a_step.push_back(i);
  std::vector<PatchEffect> wanted;
  const auto want = [&](const Ball& ball) {
    if (!is_known(ball)) wanted.push_back(told(law_, ball, number_));
  };
  const Points places = spread(lumen_.points(Eigen::all, at_a_step), around);
  for (const auto& place : places.colwise()) want({place, best_.radius});
  const double smallest = std::sqrt(areas_.mean());
  if (best_.radius / wider > smallest) want({best_.centre, best_.radius / wider});
  want({best_.centre, best_.radius * wider});
  return wanted;
}

std::vector<PatchEffect> PatchSearch::other_laws() {
  std::vector<PatchEffect> wanted;
  for (const PlacedEffect& law : laws_) {
    wanted.push_back(told(law.type, best_, {}));
    if (law.type == law_) wanted.back().other_than = number_;
  }
  return wanted;
}

PatchEffect PatchSearch::told(const std::string& type, const Ball& ball, const std::string& number) {
  const auto law = std::find_if(laws_.begin(), laws_.end(), [&](const PlacedEffect& one) { return one.type == type; });
  PatchEffect result{*law, number};
  int count = 1;
  do result.effect.path = fmt::format("solid.effects.{}_patch_{}", type, count++);
  while (!paths_.insert(result.effect.path).second);
  result.effect.is_tried = true;
  result.effect.extent.about = ball;
  result.effect.length = length_;
  result.effect.mostly_in = region_of_most(ball, lumen_, areas_);
  result.effect.one_of = std::max(1.0, areas_.sum() / (std::numbers::pi * ball.radius * ball.radius));
  told_.push_back(ball);
  return result;
}

bool PatchSearch::is_known(const Ball& ball) const {
  constexpr double same = 1.2;  // a size
  return std::any_of(told_.begin(), told_.end(), [&](const Ball& known) {
    const double ratio = std::max(known.radius / ball.radius, ball.radius / known.radius);
    return (known.centre - ball.centre).norm() < 0.4 * step_ && ratio < same;
  });
}

}  // namespace tether
